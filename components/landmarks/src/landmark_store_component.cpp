// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/landmark_use.hpp"
#include "panvo/landmarks/map_listener.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/errors.hpp"
#include "store_writer.hpp"

namespace panvo::landmarks {
namespace {

struct Parameters {
  std::string file;
  bool read_only = false;
  std::string map_frame = "map";
  int appearances = 4;
  int forget_after = 10;
  int waiting = 1000;
  int answer_s = 10;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field.path(&P::file, "file",
               "store file, created with the first landmark, or location of a PostgreSQL database, "
               "postgresql://USER@HOST/NAME; "
               "empty: landmarks are not saved");
    field(&P::read_only, "read_only", "", "publish the stored landmarks, store nothing");
    field(&P::map_frame, "map_frame", "", "frame of the stored poses");
    field(&P::appearances, "appearances", "1",
          "landmarks at one place: others are kept where the known ones were missed on two drives while most others of "
          "their sessions were missed, too, or on four",
          1, 20);
    field(&P::forget_after, "forget_after", "1",
          "drives past a landmark without recognising it, where most others of its session were recognised, after "
          "which it "
          "is removed; 0: never",
          0, 1000);
    field(
        &P::waiting, "waiting", "1",
        "changes kept in memory while the database server does not answer or another process reads the file; more are "
        "lost, those for a server counted in /diagnostics",
        10, 1'000'000);
    field(&P::answer_s, "answer_s", "s", "longest wait for an answer of the database server", 1, 600);
  }
};

/// Publishes the landmarks of a store at start, and stores new and moved ones. Poses are updated by landmarks/poses,
/// all in one transaction, or by a landmark that is received again. A database is written by another thread. From odometry/enhanced and correction/outcome it counts
/// which landmarks are recognised, and lets the map follow what has changed (see landmark_use.hpp).
class LandmarkStoreComponent final : public runtime::Component {
 public:
  explicit LandmarkStoreComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<Parameters>()), output_(context.output(topics::kLandmarks)) {
    rules_.appearances = parameters_.appearances;
    rules_.forget_after = parameters_.forget_after;
    if (parameters_.file.empty()) {
      context.log().info("no file set: the landmarks of this run will not be saved");
      return;
    }
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    map_.emplace(context, [this](const auto& moved) { on_moved(moved); });
    if (!parameters_.read_only) {
      context.input(topics::kCorrectionOutcome, [this](const auto& message) { on_outcome(*message); });
      context.input(topics::kOdometryEnhanced, [this](const auto& message) { on_odometry(*message); });
    }
    patience_.answer_s = parameters_.answer_s;
    if (!parameters_.read_only) run_.id = context.run_id();
    if (!location_.is_server()) context.about_to_read(parameters_.file);
    try {
      std::unique_ptr<LandmarkStore> store;
      if (parameters_.read_only || LandmarkStore::exists(location_, patience_)) store = open();
      if (parameters_.read_only) return;
      const auto most_waiting = static_cast<std::size_t>(parameters_.waiting);
      writer_ = location_.is_server() ? write_to_server(location_, settings_, patience_, run_, most_waiting)
                                      : write_to_file(location_, std::move(store), run_, most_waiting);
    } catch (const StoreError& error) {
      throw runtime::ConfigError(error.what());
    }
    if (location_.is_server()) context.on_diagnostics([this] { return writer_->diagnostics(); });
  }

  ~LandmarkStoreComponent() override {
    if (!writer_) return;
    writer_->finish();
    tell_notices();
  }

 private:
  static constexpr double kMaxSigma_m = 2.0;  ///< of a pose that tells which landmark is passed

  /// Publishes what is stored; returns the store, to write to it.
  std::unique_ptr<LandmarkStore> open() {
    // The store keeps the settings of the landmarks received; their users check whether they can use them.
    auto store = std::make_unique<LandmarkStore>(location_, patience_);
    settings_ = store->settings();
    if (!parameters_.read_only) {
      store = std::make_unique<LandmarkStore>(location_, *settings_, patience_);
      begin(*store);
    }
    store->read_one_state([&] { publish(*store); });
    return store;
  }

  /// After a restart, the run goes on: other components still have its landmarks by the ids that they had before.
  void begin(LandmarkStore& store) {
    if (const auto before = run_.id.empty() ? std::nullopt : store.find_run(run_.id)) {
      run_ = *before;
      for (const auto& [in_run, in_store] : run_.ids) stored_.insert(in_run);
      is_resumed_ = true;
      return;
    }
    forget(store);
    run_.session = store.next_session();
    run_.last_id = store.last_id();
  }

  void publish(const LandmarkStore& store) {
    const auto uses = parameters_.read_only ? std::map<std::uint32_t, LandmarkUse>() : store.uses();
    std::map<std::uint32_t, std::uint32_t> own;  // ids in this run of those that it added
    for (const auto& [in_run, in_store] : run_.ids) own.emplace(in_store, in_run);
    std::size_t loaded = 0;
    const auto tell = [&](const std::string& problem) {
      context_.log().warn("{}: {}: skipped. Remedy: run panvo landmarks info --check; restore a copy{}", store.name(),
                          problem, location_.is_server() ? "" : " of the file");
    };
    const auto publish_one = [&](PanoramicLandmark landmark) {
      const auto stored_id = landmark.id;
      const auto found = own.find(stored_id);
      const bool is_own = found != own.end();
      if (is_own) landmark.id = found->second;
      // Another robot added it since the run began, which may have its id for a landmark of its own.
      if (!is_own && !parameters_.read_only && (stored_id > run_.last_id || run_.ids.contains(stored_id))) return;
      try {
        landmark.keypoints = store.keypoints(stored_id);  // the thumbnail, for display only, is not published
      } catch (const StoreUnavailable&) {
        throw;
      } catch (const StoreError& error) {
        return tell(error.what());
      }
      map_->map().add(landmark);
      if (const auto use = uses.find(stored_id); use != uses.end()) uses_[landmark.id] = use->second;
      remember(landmark.id);
      if (!is_own) earlier_[landmark.id] = uses_[landmark.id];
      // The topic is latched, so subscribers may join later.
      output_.publish(to_message(landmark, store.settings(), parameters_.map_frame));
      ++loaded;
    };
    store.for_each(publish_one, tell);
    if (is_resumed_) passes_.leave_out_current();
    context_.log().info("{}: {} landmarks loaded{}", store.name(), loaded,
                        is_resumed_ ? "; this run goes on with those that it added before the restart" : "");
  }

  /// Places of a stereo camera are recognised at like headings only, so that a pass does not tell that one has changed.
  bool is_followed() const { return !settings_ || !settings_->contains("camera"); }

  void forget(LandmarkStore& store) {
    std::vector<std::uint32_t> outdated;
    for (const auto& [id, use] : store.uses()) {
      if (rules_.forgets(use)) outdated.push_back(id);
    }
    if (outdated.empty()) return;
    store.remove(outdated);
    context_.log().info(
        "{}: {} landmarks removed: on {} drives past them most others of their sessions were recognised, but not they",
        store.name(), outdated.size(), parameters_.forget_after);
  }

  void on_outcome(const panvo_msgs::msg::CorrectionOutcome& message) {
    if (message.outcome() != panvo_msgs::msg::CorrectionOutcome_Constants::REJECTED) {
      passes_.recognised(message.landmark_id());
    }
  }

  void on_odometry(const nav_msgs::msg::Odometry& message) {
    tell_notices();
    if (has_failed_ || !is_followed() || message.header().frame_id() != parameters_.map_frame) return;
    const auto& covariance = message.pose().covariance();
    if (!(std::sqrt(covariance[0] + covariance[7]) < kMaxSigma_m)) return;
    const auto& position = message.pose().pose().position();
    auto passes = passes_.move_to({position.x(), position.y()});
    if (passes.empty()) return;
    for (const auto& pass : passes) add(pass, uses_[pass.id]);
    try {
      writer_->write(PassedLandmarks{std::move(passes)});
    } catch (const StoreError& error) {
      fail(error);
    }
  }

  void tell_notices() {
    for (const auto& notice : writer_->notices()) {
      if (notice.is_error) {
        context_.log().error("{}", notice.text);
      } else {
        context_.log().info("{}", notice.text);
      }
    }
  }

  void fail(const StoreError& error) {
    has_failed_ = true;  // file errors persist; the rest of the system continues
    context_.log().error("{}. No more landmarks will be stored", error.what());
  }

  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    if (parameters_.read_only) return;
    tell_notices();
    if (has_failed_) return;
    const auto settings = settings_from_text(message.settings());
    const auto read = to_landmark(message, settings);
    if (!read) {
      context_.log().warn_throttled(fmt::format("landmark {}", message.id()), "a landmark {}; it is not stored",
                                    read.reason());
      return;
    }
    auto landmark = *read;
    if (map_->map().is_other(landmark)) {
      context_.log().warn_throttled(fmt::format("landmark {}", landmark.id),
                                    "landmark {}: its id is that of another one; it is not stored", landmark.id);
      return;
    }
    const bool is_new_pose = map_->map().add(landmark);
    try {
      writer_->require(settings);
      settings_ = settings;
      if (!stored_.contains(landmark.id)) {
        keep(landmark);
      } else if (is_new_pose) {
        move({map_->map().pose(landmark.id)});
      }
    } catch (const StoreError& error) {
      fail(error);
    } catch (const std::invalid_argument& error) {
      context_.log().warn("{}: not stored", error.what());
    }
  }

  void on_moved(std::vector<LandmarkPose> moved) {
    if (parameters_.read_only || has_failed_) return;
    std::erase_if(moved, [this](const auto& pose) { return !stored_.contains(pose.id); });
    if (moved.empty()) return;
    try {
      move(moved);
    } catch (const StoreError& error) {
      fail(error);
    } catch (const std::invalid_argument& error) {
      context_.log().warn("{}: landmark poses are unchanged", error.what());
    }
  }

  void keep(const PanoramicLandmark& landmark) {
    if (!make_room_for(landmark)) return;
    NewLandmark added{landmark, *settings_, std::nullopt};
    if (is_followed()) {
      added.use = uses_[landmark.id];
      added.use->session = run_.session;
    }
    // Not remembered, it is not moved later, either: by then, another robot's landmark may have its id.
    if (!writer_->write(added)) return;
    if (added.use) uses_[landmark.id] = *added.use;
    remember(landmark.id);
  }

  /// Whether a landmark is kept beside those of earlier runs; removes the one that it replaces.
  bool make_room_for(const PanoramicLandmark& landmark) {
    if (!is_followed()) return true;
    std::vector<std::uint32_t> ids;
    std::vector<UseRules::Neighbour> neighbours;
    for (const auto& [id, use] : earlier_) {
      const Eigen::Vector3d between =
          map_->map().pose(id).map_from_base.translation() - landmark.map_from_base.translation();
      if (between.head<2>().norm() > rules_.same_place_m) continue;
      ids.push_back(id);
      neighbours.push_back({use, passes_.looks_different(use.session)});
    }
    const auto admission = rules_.admit(neighbours);
    if (!admission.is_kept) return false;
    if (admission.instead_of) {
      const auto outdated = ids[*admission.instead_of];
      if (!writer_->write(RemovedLandmark{outdated})) return false;
      earlier_.erase(outdated);
      uses_.erase(outdated);
      stored_.erase(outdated);
    }
    if (!ids.empty()) context_.log().info("landmark {} is kept beside {} at its place", landmark.id, ids.front());
    return true;
  }

  /// In one transaction, so that the stored map is never partly optimised.
  void move(const std::vector<LandmarkPose>& poses) {
    writer_->write(MovedLandmarks{poses});
    for (const auto& pose : poses) remember(pose.id);
  }

  void remember(std::uint32_t id) {
    stored_.insert(id);
    passes_.set_landmark(id, map_->map().pose(id).map_from_base.translation().head<2>(), uses_[id].session);
  }

  runtime::Context& context_;
  const Parameters parameters_;
  runtime::Output<panvo_msgs::msg::PanoramicLandmark> output_;
  const StoreLocation location_{parameters_.file};
  StorePatience patience_;
  std::unique_ptr<StoreWriter> writer_;          // none: nothing is stored
  std::optional<DescriptionSettings> settings_;  // of the store, once there is one
  std::optional<MapListener> map_;
  std::set<std::uint32_t> stored_;
  UseRules rules_;
  PassCounter passes_;
  std::map<std::uint32_t, LandmarkUse> uses_;
  std::map<std::uint32_t, LandmarkUse> earlier_;  // of the landmarks of earlier runs, when this one began
  StoredRun run_;                                 ///< this one
  bool is_resumed_ = false;                       ///< goes on after a restart
  bool has_failed_ = false;
};

}  // namespace
}  // namespace panvo::landmarks

namespace {
using panvo::landmarks::LandmarkStoreComponent;
}
PANVO_REGISTER_COMPONENT(LandmarkStoreComponent)

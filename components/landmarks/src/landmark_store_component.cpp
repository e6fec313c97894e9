// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "map_use.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/id_disputes.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/landmarks/landmark_use.hpp"
#include "panvo/landmarks/last_kept.hpp"
#include "panvo/landmarks/map_listener.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/errors.hpp"
#include "run_finder.hpp"
#include "save_service.hpp"
#include "store_parameters.hpp"
#include "store_writer.hpp"

namespace panvo::landmarks {

/// Publishes the landmarks of a store at start, and stores new and moved ones. Poses are updated by landmarks/poses,
/// all in one transaction, or by a landmark that is received again. A database is written by another thread. From
/// odometry/enhanced and correction/outcome it counts which landmarks are recognised, and lets the map follow what has
/// changed (see landmark_use.hpp).
class LandmarkStoreComponent final : public runtime::Component {
 public:
  explicit LandmarkStoreComponent(runtime::Context& context)
      : context_(context),
        parameters_(context.parameters<StoreParameters>()),
        output_(context.output(topics::kLandmarks)) {
    offer_saving(context, location_, [this] {
      return finder_ ? std::nullopt : std::optional(writer_ ? writer_->waiting() : std::size_t{0});
    });
    if (parameters_.file.empty()) {
      context.log().info("no file set: the landmarks of this run will not be saved");
      return;
    }
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(message); });
    map_.emplace(context, [this](const auto& moved) { on_moved(moved); });
    if (!parameters_.read_only) {
      run_.id = context.run_id();
      context.input(topics::kCorrectionOutcome, [this](const auto& message) { on_outcome(*message); });
      context.input(topics::kOdometryEnhanced, [this](const auto& message) { on_odometry(*message); });
    }
    patience_.answer_s = parameters_.answer_s;
    if (!location_.is_server()) context.about_to_read(parameters_.file);
    try {
      if (parameters_.read_only || LandmarkStore::exists(location_, patience_)) open();
      if (!finder_) start();
    } catch (const StoreError& error) {
      throw runtime::ConfigError(error.what());
    }
    if (finder_) {
      context.every(std::chrono::seconds(kListen_s), [this] { settle(); });
      context.on_end([this] { settle(); });
    }
    if (location_.is_server() && !parameters_.read_only) {
      context.on_diagnostics([this] {
        const auto* const writer = diagnosed_.load();
        return writer == nullptr ? runtime::DiagnosticValues{} : writer->diagnostics();
      });
    }
  }

  ~LandmarkStoreComponent() override {
    if (writer_) writer_->finish();
    tell_notices();
  }

 private:
  static constexpr double kMaxSigma_m = 2.0;  ///< of a pose that tells which landmark is passed
  /// For what the others have to say: DDS announces participants every 3 s.
  static constexpr int kListen_s = 3;

  void open() {
    // The store keeps the settings of the landmarks received; their users check whether they can use them.
    store_ = std::make_unique<LandmarkStore>(location_, patience_);
    settings_ = store_->settings();
    if (parameters_.read_only) return;
    store_ = std::make_unique<LandmarkStore>(location_, *settings_, patience_);
    if (run_.id.empty()) return;
    auto runs = store_->runs();
    const auto own = std::ranges::find(runs, run_.id, &StoredRun::id);
    if (own != runs.end()) {
      resumed_ = *own;
    } else {
      if (location_.is_server()) keep_of_component(runs, run_);  // as a database has the runs of all robots
      finder_ = RunFinder::among(std::move(runs), *store_);
    }
  }

  /// Publishes what is stored, and goes on to write.
  void start() {
    if (store_) {
      if (!parameters_.read_only) begin(*store_);
      store_->read_one_state([&] { publish(*store_); });
    }
    if (parameters_.read_only) return store_.reset();
    const auto most_waiting = static_cast<std::size_t>(parameters_.waiting);
    writer_ = location_.is_server() ? write_to_server(location_, settings_, patience_, run_, most_waiting)
                                    : write_to_file(location_, std::move(store_), run_, most_waiting);
    store_.reset();
    diagnosed_ = writer_.get();
  }

  /// Starts once the others have said which run this is, or could have.
  void settle() {
    if (!finder_) return;
    resumed_ = finder_->found();
    map_->map() = MapReplica();  // its ids may be others
    try {
      start();
    } catch (const StoreUnavailable& error) {
      return context_.log().warn_throttled("start", "{}. The landmarks come when it answers", error.what());
    } catch (const StoreError& error) {
      fail(error);
    }
    const auto heard = std::exchange(finder_, std::nullopt);
    std::vector<LandmarkPose> poses;
    for (const auto& [id, pose] : heard->poses()) poses.push_back(pose);
    if (!poses.empty()) on_moved(map_->map().move(poses));
    if (early_.dropped() > 0) {
      context_.log().warn("{} landmarks are not stored: more than {} came before it was known which run this is",
                          early_.dropped(), early_.most());
    }
    for (const auto& message : early_.take()) on_landmark(message);
  }

  /// After a restart, the run goes on: other components still have its landmarks by the ids that they had before.
  void begin(LandmarkStore& store) {
    if (resumed_) {
      run_ = *resumed_;
      for (const auto& [in_run, in_store] : run_.ids) stored_.insert(in_run);
      return;
    }
    forget(store);
    run_.session = store.next_session();
    run_.last_id = store.last_id();
  }

  void publish(const LandmarkStore& store) {
    const auto uses = parameters_.read_only ? std::map<std::uint32_t, LandmarkUse>() : store.uses();
    const auto own = run_.own_ids();
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
      if (!is_own && !parameters_.read_only && run_.may_have_other_of_id(stored_id)) return;
      try {
        landmark.keypoints = store.keypoints(stored_id);  // the thumbnail, for display only, is not published
      } catch (const StoreUnavailable&) {
        throw;
      } catch (const StoreError& error) {
        return tell(error.what());
      }
      map_->map().add(landmark);
      const auto use = uses.contains(stored_id) ? uses.at(stored_id) : LandmarkUse{};
      const auto before = is_own ? std::nullopt : std::optional(run_.use_before(stored_id, use));
      remember(map_->map().pose(landmark.id), use, before);
      // The topic is latched, so subscribers may join later.
      output_.publish(to_message(landmark, store.settings(), parameters_.map_frame));
      ++loaded;
    };
    store.for_each(publish_one, tell);
    if (resumed_) use_.leave_out_current();
    context_.log().info("{}: {} landmarks loaded{}", store.name(), loaded,
                        resumed_ ? "; this run goes on with those that it added before the restart" : "");
  }

  /// Places of a stereo camera are recognised at like headings only, so that a pass does not tell that one has changed.
  bool is_followed() const { return !settings_ || !settings_->contains("camera"); }

  void forget(LandmarkStore& store) {
    const auto outdated = use_.outdated(store.uses());
    if (outdated.empty()) return;
    store.remove(outdated);
    context_.log().info(
        "{}: {} landmarks removed: on {} drives past them most others of their sessions were recognised, but not they",
        store.name(), outdated.size(), parameters_.forget_after);
  }

  void on_outcome(const panvo_msgs::msg::CorrectionOutcome& message) {
    if (message.outcome() != panvo_msgs::msg::CorrectionOutcome_Constants::REJECTED) {
      use_.recognised(message.landmark_id());
    }
  }

  void on_odometry(const nav_msgs::msg::Odometry& message) {
    if (finder_) return;
    tell_notices();
    if (has_failed_ || !is_followed() || message.header().frame_id() != parameters_.map_frame) return;
    const auto& covariance = message.pose().covariance();
    if (!(std::sqrt(covariance[0] + covariance[7]) < kMaxSigma_m)) return;
    const auto& position = message.pose().pose().position();
    auto passes = use_.drive_to({position.x(), position.y()});
    std::erase_if(passes, [this](const auto& pass) { return disputes_.is_disputed(pass.id); });
    if (passes.empty()) return;
    try {
      writer_->write(PassedLandmarks{std::move(passes)});
    } catch (const StoreError& error) {
      fail(error);
    }
  }

  void tell_notices() {
    if (!writer_) return;
    for (const auto& notice : writer_->notices()) {
      notice.is_error ? context_.log().error("{}", notice.text) : context_.log().info("{}", notice.text);
    }
  }

  void fail(const StoreError& error) {
    has_failed_ = true;  // file errors persist; the rest of the system continues
    context_.log().error("{}. No more landmarks will be stored", error.what());
  }

  void on_landmark(const std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>& shared) {
    if (parameters_.read_only) return;
    tell_notices();
    if (has_failed_) return;
    const auto& message = *shared;
    const auto settings = settings_from_text(message.settings());
    const auto read = to_landmark(message, settings);
    if (!read) {
      context_.log().warn_throttled(fmt::format("landmark {}", message.id()), "a landmark {}; it is not stored",
                                    read.reason());
      return;
    }
    auto landmark = *read;
    if (finder_) {
      early_.add(shared);
      if (finder_->hear(landmark)) settle();
      return;
    }
    try {
      if (map_->map().is_other(landmark)) return dispute(landmark);
      const bool is_new_pose = map_->map().add(landmark);
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

  /// Of two that have one id, neither is moved to the place of the other.
  void dispute(const PanoramicLandmark& other) {
    context_.log().warn_throttled(fmt::format("landmark {}", other.id),
                                  "landmark {}: its id is that of another one; it is not stored", other.id);
    if (const auto back = disputes_.begin({other.id, other.map_from_base, other.covariance})) move({*back});
  }

  void on_moved(std::vector<LandmarkPose> moved) {
    if (parameters_.read_only || has_failed_) return;
    if (finder_) return finder_->hear(moved);
    std::erase_if(moved, [this](const auto& pose) { return !stored_.contains(pose.id) || !disputes_.move(pose); });
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
    const auto use = is_followed() ? std::optional(LandmarkUse{run_.session}) : std::nullopt;
    // Not remembered, it is not moved later, either: by then, another robot's landmark may have its id.
    if (!writer_->write(NewLandmark{landmark, *settings_, use})) return;
    remember(map_->map().pose(landmark.id), use.value_or(LandmarkUse{}), std::nullopt);
  }

  /// Whether a landmark is kept beside those of earlier runs; removes the one that it replaces.
  bool make_room_for(const PanoramicLandmark& landmark) {
    if (!is_followed()) return true;
    const auto admission = use_.admit(landmark.map_from_base.translation().head<2>());
    if (!admission.is_kept) return false;
    if (const auto outdated = admission.instead_of) {
      if (!writer_->write(RemovedLandmark{*outdated})) return false;
      use_.forget(*outdated);
      stored_.erase(*outdated);
      disputes_.forget(*outdated);
    }
    if (admission.beside) {
      context_.log().info("landmark {} is kept beside {} at its place", landmark.id, *admission.beside);
    }
    return true;
  }

  /// In one transaction, so that the stored map is never partly optimised.
  void move(const std::vector<LandmarkPose>& poses) {
    writer_->write(MovedLandmarks{poses});
    for (const auto& pose : poses) use_.move(pose);
  }

  void remember(const LandmarkPose& pose, const LandmarkUse& use, const std::optional<LandmarkUse>& before) {
    stored_.insert(pose.id);
    disputes_.keep(pose);
    use_.add(pose, use, before);
  }

  runtime::Context& context_;
  const StoreParameters parameters_;
  runtime::Output<panvo_msgs::msg::PanoramicLandmark> output_;
  const StoreLocation location_{parameters_.file};
  StorePatience patience_;
  std::unique_ptr<LandmarkStore> store_;  // until start()
  std::unique_ptr<StoreWriter> writer_;   // none: nothing is stored
  std::atomic<const StoreWriter*> diagnosed_ = nullptr;
  std::optional<DescriptionSettings> settings_;  // of the store, once there is one
  std::optional<MapListener> map_;
  std::set<std::uint32_t> stored_;
  MapUse use_{parameters_.rules()};
  StoredRun run_;                     ///< this one
  std::optional<StoredRun> resumed_;  ///< this one as it was before a restart
  std::optional<RunFinder> finder_;   ///< until it is known whether this run is one of before
  LastKept<std::shared_ptr<const panvo_msgs::msg::PanoramicLandmark>> early_{
      static_cast<std::size_t>(parameters_.waiting)};  ///< came until then
  IdDisputes disputes_;
  bool has_failed_ = false;
};

PANVO_REGISTER_COMPONENT(LandmarkStoreComponent)

}  // namespace panvo::landmarks

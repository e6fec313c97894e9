// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/landmark_messages.hpp"
#include "panvo/landmarks/landmark_store.hpp"
#include "panvo/runtime/component.hpp"
#include "panvo/runtime/errors.hpp"

namespace panvo::landmarks {
namespace {

struct Parameters {
  std::string file;
  bool read_only = false;
  std::string map_frame = "map";

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field.path(&P::file, "file", "store file, created with the first landmark; empty: landmarks are not saved");
    field(&P::read_only, "read_only", "", "publish the stored landmarks, store nothing");
    field(&P::map_frame, "map_frame", "", "frame of the stored poses");
  }
};

/// Publishes the landmarks of a store at start, and stores new and moved ones. Poses are updated by landmarks/poses,
/// all in one transaction, or by a landmark that is received again.
class LandmarkStoreComponent final : public runtime::Component {
 public:
  explicit LandmarkStoreComponent(runtime::Context& context)
      : context_(context), parameters_(context.parameters<Parameters>()), output_(context.output(topics::kLandmarks)) {
    if (parameters_.file.empty()) {
      context.log().info("no file set: the landmarks of this run will not be saved");
      return;
    }
    context.input(topics::kLandmarks, [this](const auto& message) { on_landmark(*message); });
    context.input(topics::kLandmarkPoses, [this](const auto& message) { on_poses(*message); });
    context.about_to_read(parameters_.file);
    try {
      if (parameters_.read_only || std::filesystem::exists(parameters_.file)) open();
    } catch (const StoreError& error) {
      throw runtime::ConfigError(error.what());
    }
  }

 private:
  struct Known {
    Eigen::Matrix4d map_from_base;
    Eigen::Matrix<double, 6, 6> covariance;
  };

  void open() {
    // The store keeps the settings of the landmarks received; their users check whether they can use them.
    store_ = std::make_unique<LandmarkStore>(parameters_.file);
    if (!parameters_.read_only) {
      const auto settings = store_->settings();
      store_ = std::make_unique<LandmarkStore>(parameters_.file, settings);
    }
    const auto tell = [this](const std::string& problem) {
      context_.log().warn("{}: {}: skipped. Remedy: run panvo landmarks info --check; restore a copy of the file",
                          parameters_.file, problem);
    };
    for (auto& landmark : store_->landmarks(tell)) {
      try {
        landmark.keypoints = store_->keypoints(landmark.id);  // the thumbnail, for display only, is not published
      } catch (const StoreError& error) {
        tell(error.what());
        continue;
      }
      remember({landmark.id, landmark.map_from_base, landmark.covariance});
      // The topic is latched, so subscribers may join later.
      output_.publish(to_message(landmark, store_->settings(), parameters_.map_frame));
    }
    context_.log().info("{}: {} landmarks loaded", parameters_.file, known_.size());
  }

  void on_landmark(const panvo_msgs::msg::PanoramicLandmark& message) {
    if (parameters_.read_only || has_failed_) return;
    const auto settings = settings_from_text(message.settings());
    const auto landmark = to_landmark(message, settings);
    if (!landmark) {
      context_.log().warn_throttled(fmt::format("landmark {}", message.id()), "a landmark {}; it is not stored",
                                    landmark.reason());
      return;
    }
    try {
      if (!store_) store_ = std::make_unique<LandmarkStore>(parameters_.file, settings);
      store_->require(settings);
      keep(*landmark);
    } catch (const StoreError& error) {
      has_failed_ = true;  // file errors persist; the rest of the system continues
      context_.log().error("{}. No more landmarks will be stored", error.what());
    } catch (const std::invalid_argument& error) {
      context_.log().warn("{}: not stored", error.what());
    }
  }

  void on_poses(const panvo_msgs::msg::LandmarkPoses& message) {
    if (parameters_.read_only || has_failed_) return;
    const auto poses = to_landmark_poses(message);
    if (!poses) {
      context_.log().warn_throttled(poses.reason(), "{} {}; landmark poses are unchanged",
                                    context_.resolved_name(topics::kLandmarkPoses), poses.reason());
      return;
    }
    try {
      early_.clear();
      move(*poses);
    } catch (const StoreError& error) {
      has_failed_ = true;
      context_.log().error("{}. No more landmarks will be stored", error.what());
    } catch (const std::invalid_argument& error) {
      context_.log().warn("{}: landmark poses are unchanged", error.what());
    }
  }

  void keep(PanoramicLandmark landmark) {
    if (known_.contains(landmark.id)) {
      const LandmarkPose pose{landmark.id, landmark.map_from_base, landmark.covariance};
      return move(std::span(&pose, 1));
    }
    if (const auto early = early_.find(landmark.id); early != early_.end()) {
      landmark.map_from_base = early->second.map_from_base;
      landmark.covariance = early->second.covariance;
    }
    store_->add(landmark);
    remember({landmark.id, landmark.map_from_base, landmark.covariance});
  }

  /// In one transaction, so that the stored map is never partly optimised.
  void move(std::span<const LandmarkPose> poses) {
    std::vector<LandmarkPose> moved;
    for (const auto& pose : poses) {
      const auto known = known_.find(pose.id);
      if (known == known_.end()) {
        early_[pose.id] = pose;
      } else if (is_moved(known->second, pose)) {
        moved.push_back(pose);
      }
    }
    if (moved.empty()) return;
    store_->set_poses(moved);
    for (const auto& pose : moved) remember(pose);
  }

  static bool is_moved(const Known& known, const LandmarkPose& pose) {
    constexpr double kRounding = 1e-9;  // rounding of rotations as quaternions: published poses come back
    return (known.map_from_base - pose.map_from_base.matrix()).cwiseAbs().maxCoeff() > kRounding ||
           known.covariance != pose.covariance;
  }

  void remember(const LandmarkPose& pose) {
    known_.insert_or_assign(pose.id, Known{pose.map_from_base.matrix(), pose.covariance});
  }

  runtime::Context& context_;
  const Parameters parameters_;
  runtime::Output<panvo_msgs::msg::PanoramicLandmark> output_;
  std::unique_ptr<LandmarkStore> store_;
  std::map<std::uint32_t, Known> known_;
  std::map<std::uint32_t, LandmarkPose> early_;  // poses of landmarks not received yet
  bool has_failed_ = false;
};

}  // namespace
}  // namespace panvo::landmarks

namespace {
using panvo::landmarks::LandmarkStoreComponent;
}
PANVO_REGISTER_COMPONENT(LandmarkStoreComponent)

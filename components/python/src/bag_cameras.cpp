// SPDX-License-Identifier: Apache-2.0
#include "bag_cameras.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "recording.hpp"

namespace panvo::python {
namespace {

using dataset_player::DatasetError;

constexpr const char* kBase = "base_link";
constexpr const char* kImage = "sensor_msgs/msg/Image";

std::string type_of_role(const std::string& role) {
  if (role.ends_with("_info")) return "sensor_msgs/msg/CameraInfo";
  if (role == "ground_truth") return "nav_msgs/msg/Odometry";
  return role == "tf_static" ? "tf2_msgs/msg/TFMessage" : kImage;
}

std::string absolute(std::string_view name) {
  return name.starts_with('/') ? std::string(name) : fmt::format("/{}", name);
}

/// Collects the first camera_info of each eye, the static transforms, the panorama's frame and the ground truth.
class Survey {
 public:
  explicit Survey(const BagTopics& topics) : topics_(topics) {}

  void add(const std::string& topic, const recorder::BagMessage& message) {
    const auto role = topics_.role_of(topic);
    if (role == "tf_static") {
      buffer_.add_static(*decode<tf2_msgs::msg::TFMessage>(message));
    } else if (role == "ground_truth") {
      add_truth(*decode<nav_msgs::msg::Odometry>(message));
    } else if (role == "panorama") {
      if (panorama_frame_.empty()) panorama_frame_ = decode<sensor_msgs::msg::Image>(message)->header().frame_id();
    } else if (!infos_.contains(role)) {
      infos_[role] = decode<sensor_msgs::msg::CameraInfo>(message);
    }
  }

  BagCameras cameras(const std::string& path) {
    BagCameras cameras;
    cameras.ground_truth = std::move(truth_);
    if (topics_.has("panorama")) cameras.base_from_panorama = place(panorama_frame_, cameras.notes);
    if (topics_.has("left") && topics_.has("right")) {
      if (infos_.contains("left_info") && infos_.contains("right_info")) {
        cameras.stereo = stereo(path, cameras.notes);
      } else {
        cameras.notes.push_back(fmt::format("{}: has no camera_info of left and right camera", path));
      }
    }
    return cameras;
  }

 private:
  void add_truth(const nav_msgs::msg::Odometry& odometry) {
    const auto pose = conversions::to_isometry(odometry.pose().pose());
    const auto stamp_ns = conversions::stamp_ns(odometry);
    if (pose && (truth_.empty() || stamp_ns > truth_.back().stamp_ns)) truth_.push_back({stamp_ns, *pose});
  }

  Eigen::Isometry3d place(const std::string& frame, std::vector<std::string>& notes) const {
    const auto found = buffer_.lookup(kBase, frame);
    if (!found) notes.push_back(fmt::format("/tf_static has no chain from {} to {}", kBase, frame));
    return found.value_or(Eigen::Isometry3d::Identity());
  }

  conversions::PairedCamera camera(const std::string& role, const std::string& path) const {
    const auto read = conversions::to_camera(*infos_.at(role));
    if (!read) throw DatasetError(fmt::format("{}: {} {}", path, topics_.by_role.at(role), read.reason()));
    return *read;
  }

  StereoPair stereo(const std::string& path, std::vector<std::string>& notes) const {
    const auto left = camera("left_info", path);
    const auto right = camera("right_info", path);
    const auto rectified = conversions::to_stereo(left, right);
    if (!rectified) {
      throw DatasetError(fmt::format("{}: {} and {} do not form a stereo pair: {}", path,
                                     topics_.by_role.at("left_info"), topics_.by_role.at("right_info"),
                                     rectified.reason()));
    }
    StereoPair pair{{left.raw, right.raw, {}}, *rectified, place(infos_.at("left_info")->header().frame_id(), notes)};
    if (topics_.is_rectified) {
      pair.base_from_left = pair.base_from_rectified_left();
      pair.raw.left = pair.raw.right = {rectified->camera, {}, {}};
      pair.rectified.rectified_left_from_left.setIdentity();
      pair.rectified.rectified_right_from_right.setIdentity();
    }
    const Eigen::Matrix3d right_from_rectified = pair.rectified.rectified_right_from_right.transpose();
    pair.raw.right_from_left.setIdentity();
    pair.raw.right_from_left.linear() = right_from_rectified * pair.rectified.rectified_left_from_left;
    pair.raw.right_from_left.translation() = right_from_rectified * Eigen::Vector3d(-rectified->baseline_m, 0.0, 0.0);
    return pair;
  }

  const BagTopics& topics_;
  conversions::TransformBuffer buffer_;
  std::map<std::string, std::shared_ptr<const sensor_msgs::msg::CameraInfo>> infos_;
  std::string panorama_frame_;
  std::vector<dataset_player::GroundTruthPose> truth_;
};

}  // namespace

const std::map<std::string, std::string>& bag_roles() {
  static const std::map<std::string, std::string> kRoles{{"left", absolute(topics::kStereoLeftImageRaw.name)},
                                                         {"right", absolute(topics::kStereoRightImageRaw.name)},
                                                         {"left_info", absolute(topics::kStereoLeftCameraInfo.name)},
                                                         {"right_info", absolute(topics::kStereoRightCameraInfo.name)},
                                                         {"panorama", absolute(topics::kPanorama.name)},
                                                         {"ground_truth", absolute(topics::kGroundTruth.name)},
                                                         {"tf_static", absolute(topics::kTfStatic.name)}};
  return kRoles;
}

std::string BagTopics::role_of(const std::string& topic) const {
  const auto found =
      std::find_if(by_role.begin(), by_role.end(), [&](const auto& role) { return role.second == topic; });
  return found == by_role.end() ? std::string() : found->first;
}

BagTopics find_topics(const recorder::BagMetadata& bag, const std::map<std::string, std::string>& given,
                      const std::filesystem::path& path) {
  for (const auto& [role, name] : given) {
    if (bag_roles().contains(role)) continue;
    std::vector<std::string> known;
    for (const auto& [other, topic] : bag_roles()) known.push_back(other);
    throw std::invalid_argument(
        fmt::format("topics: '{}' is not a role; the roles are {}", role, fmt::join(known, ", ")));
  }
  const auto find = [&](const std::string& name) {
    return std::find_if(bag.topics.begin(), bag.topics.end(), [&](const auto& topic) { return topic.name == name; });
  };
  BagTopics topics;
  const auto take = [&](const std::string& role, const std::string& name, bool is_given) {
    const auto topic = find(name);
    if (topic == bag.topics.end()) {
      if (is_given) throw DatasetError(fmt::format("{}: has no topic {}; see panvo bag info", path.string(), name));
      return false;
    }
    if (const auto type = recorder::full_type_name(topic->type); type != type_of_role(role)) {
      throw DatasetError(
          fmt::format("{}: {} holds {}, but {} must be {}", path.string(), name, type, role, type_of_role(role)));
    }
    topics.by_role[role] = name;
    return true;
  };
  for (const auto& [role, usual] : bag_roles()) {
    const auto chosen = given.find(role);
    take(role, chosen == given.end() ? usual : absolute(chosen->second), chosen != given.end());
  }
  if (!topics.has("left") && !topics.has("right")) {
    const bool has_left = take("left", absolute(topics::kStereoLeftImageRect.name), false);
    const bool has_right = take("right", absolute(topics::kStereoRightImageRect.name), false);
    topics.is_rectified = has_left && has_right;
  }
  return topics;
}

BagCameras read_cameras(recorder::BagReader& bag, const BagTopics& topics) {
  Survey survey(topics);
  const auto read = [&](const std::string& role, bool whole) {
    if (!topics.has(role)) return;
    const auto& name = topics.by_role.at(role);
    bag.select([&](const recorder::BagTopic& topic) { return topic.name == name; });
    while (const auto* message = bag.next()) {
      survey.add(name, *message);
      if (!whole) return;
    }
  };
  for (const char* role : {"tf_static", "ground_truth"}) read(role, true);
  for (const char* role : {"left_info", "right_info", "panorama"}) read(role, false);
  return survey.cameras(bag.path().string());
}

}  // namespace panvo::python

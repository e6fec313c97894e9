// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_messages.hpp"

#include <optional>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/validity.hpp"

namespace panvo::landmarks {
namespace {

using FeatureMessages = std::vector<panvo_msgs::msg::AdaptiveFeature>;
using conversions::Reason;

std::array<float, 3> to_array(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }
Eigen::Vector3f to_vector(const std::array<float, 3>& array) { return {array[0], array[1], array[2]}; }

FeatureMessages to_messages(const std::vector<AdaptiveFeature>& features) {
  FeatureMessages messages(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    messages[i].row(features[i].row);
    messages[i].value(features[i].value);
    messages[i].scale(features[i].scale);
    messages[i].weight(features[i].weight);
  }
  return messages;
}

std::vector<AdaptiveFeature> to_features(const FeatureMessages& messages) {
  std::vector<AdaptiveFeature> features;
  features.reserve(messages.size());
  for (const auto& message : messages) {
    features.push_back({message.row(), message.value(), message.scale(), message.weight()});
  }
  return features;
}

}  // namespace

std::vector<panvo_msgs::msg::LandmarkKeypoint> to_keypoint_messages(const std::vector<Keypoint>& keypoints) {
  std::vector<panvo_msgs::msg::LandmarkKeypoint> messages(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    messages[i].bearing(to_array(keypoints[i].bearing));
    messages[i].size_px(keypoints[i].size_px);
    messages[i].descriptor(keypoints[i].descriptor);
    messages[i].has_point(keypoints[i].has_point);
    messages[i].point(to_array(keypoints[i].point_in_panorama));
    messages[i].inverse_range_sigma(keypoints[i].inverse_range_sigma);
  }
  return messages;
}

std::vector<Keypoint> to_keypoints(const std::vector<panvo_msgs::msg::LandmarkKeypoint>& messages) {
  std::vector<Keypoint> keypoints;
  keypoints.reserve(messages.size());
  for (const auto& message : messages) {
    keypoints.push_back({to_vector(message.bearing()), message.size_px(), message.descriptor(), message.has_point(),
                         to_vector(message.point()), message.inverse_range_sigma()});
  }
  return keypoints;
}

panvo_msgs::msg::PanoramicLandmark to_message(const PanoramicLandmark& landmark, const DescriptionSettings& settings,
                                              const std::string& map_frame) {
  panvo_msgs::msg::PanoramicLandmark message;
  message.header().stamp(conversions::to_stamp(landmark.stamp_ns));
  message.header().frame_id(map_frame);
  message.id(landmark.id);
  message.pose().pose(conversions::to_pose(landmark.map_from_base));
  message.pose().covariance(conversions::to_array(landmark.covariance));
  message.panorama_pose(conversions::to_pose(landmark.base_from_panorama));
  message.is_junction(landmark.is_junction);
  message.settings(to_text(settings));
  message.histogram(landmark.description.histogram);
  message.large_features(to_messages(landmark.description.large));
  message.small_features(to_messages(landmark.description.small));
  message.keypoints(to_keypoint_messages(landmark.keypoints));
  message.thumbnail(landmark.thumbnail);
  return message;
}

conversions::Result<PanoramicLandmark> to_landmark(const panvo_msgs::msg::PanoramicLandmark& message,
                                                   const DescriptionSettings& settings) {
  if (const auto found = differences(settings_from_text(message.settings()), settings); !found.empty()) {
    std::string reason = "was described with other settings: ";
    for (std::size_t i = 0; i < found.size(); ++i) reason += (i == 0 ? "" : "; ") + found[i];
    return Reason{reason};
  }
  if (const auto problem = interfaces::problem_of(message)) return Reason{"cannot be used: " + *problem};
  const auto map_from_base = conversions::to_isometry(message.pose().pose());
  if (!map_from_base) return Reason{map_from_base.reason() + " (its pose)"};
  const auto base_from_panorama = conversions::to_isometry(message.panorama_pose());
  if (!base_from_panorama) return Reason{base_from_panorama.reason() + " (the panorama's pose)"};

  PanoramicLandmark landmark;
  landmark.id = message.id();
  landmark.stamp_ns = conversions::stamp_ns(message);
  landmark.map_from_base = *map_from_base;
  landmark.covariance = conversions::to_matrix(message.pose().covariance());
  landmark.base_from_panorama = *base_from_panorama;
  landmark.is_junction = message.is_junction();
  landmark.description.histogram = message.histogram();
  landmark.thumbnail = message.thumbnail();
  landmark.description.large = to_features(message.large_features());
  landmark.description.small = to_features(message.small_features());
  landmark.keypoints = to_keypoints(message.keypoints());
  return landmark;
}

conversions::Result<std::vector<LandmarkPose>> to_landmark_poses(const panvo_msgs::msg::LandmarkPoses& message) {
  if (const auto problem = interfaces::problem_of(message)) return Reason{"cannot be used: " + *problem};
  std::vector<LandmarkPose> poses;
  poses.reserve(message.ids().size());
  for (std::size_t i = 0; i < message.ids().size(); ++i) {
    const auto pose = conversions::to_isometry(message.poses()[i].pose());
    if (!pose) return Reason{pose.reason()};
    poses.push_back({message.ids()[i], *pose, conversions::to_matrix(message.poses()[i].covariance())});
  }
  return poses;
}

}  // namespace panvo::landmarks

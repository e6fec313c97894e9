// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_messages.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

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

std::vector<panvo_msgs::msg::LandmarkKeypoint> to_messages(const std::vector<Keypoint>& keypoints) {
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

/// What is wrong with a list of features; nothing when it can be used.
std::optional<std::string> read(const FeatureMessages& messages, const std::string& name,
                                std::vector<AdaptiveFeature>& features) {
  features.reserve(messages.size());
  for (const auto& message : messages) {
    const AdaptiveFeature feature{message.row(), message.value(), message.scale(), message.weight()};
    const auto where = " in " + name + "[" + std::to_string(features.size()) + "]";
    if (!std::isfinite(feature.value) || !std::isfinite(feature.scale) || !std::isfinite(feature.weight)) {
      return "has a value that is not finite" + where;
    }
    if (feature.scale <= 0.0f || feature.weight < 0.0f || feature.weight > 1.0f) {
      return "has a scale or a weight out of its range" + where;
    }
    if (!features.empty() && feature.weight > features.back().weight) {
      return "has features that are not in order of their weights" + where;
    }
    features.push_back(feature);
  }
  return std::nullopt;
}

std::optional<std::string> read(const std::vector<panvo_msgs::msg::LandmarkKeypoint>& messages,
                                std::vector<Keypoint>& keypoints) {
  constexpr float kTolerance = 1e-3f;
  keypoints.reserve(messages.size());
  for (const auto& message : messages) {
    Keypoint keypoint{to_vector(message.bearing()), message.size_px(),          message.descriptor(),
                      message.has_point(),          to_vector(message.point()), message.inverse_range_sigma()};
    const auto where = " in keypoints[" + std::to_string(keypoints.size()) + "]";
    if (!keypoint.bearing.allFinite() || !std::isfinite(keypoint.size_px) || !keypoint.point_in_panorama.allFinite() ||
        !std::isfinite(keypoint.inverse_range_sigma)) {
      return "has a value that is not finite" + where;
    }
    if (std::abs(keypoint.bearing.norm() - 1.0f) > kTolerance) return "has a bearing that is not of length 1" + where;
    if (keypoint.has_point && keypoint.inverse_range_sigma < 0.0f) return "has a negative sigma" + where;
    keypoints.push_back(keypoint);
  }
  return std::nullopt;
}

std::optional<std::string> wrong_with_histogram(const std::vector<float>& histogram) {
  // A float's rounding over many bins, and no more.
  constexpr double kTolerance = 1e-3;
  const bool is_share = std::all_of(histogram.begin(), histogram.end(), [](float share) { return share >= 0.0f; });
  const double sum = std::accumulate(histogram.begin(), histogram.end(), 0.0);
  if (histogram.empty() || !is_share || !(std::abs(sum - 1.0) <= kTolerance)) {
    return "has a histogram whose shares do not add up to 1";
  }
  return std::nullopt;
}

std::optional<std::string> wrong_with_covariance(const Eigen::Matrix<double, 6, 6>& covariance) {
  if (!covariance.allFinite()) return "has a covariance that is not finite";
  const double tolerance = 1e-6 * covariance.cwiseAbs().maxCoeff();
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > tolerance ||
      (covariance.diagonal().array() < 0.0).any()) {
    return "has a covariance that is not symmetric or has a negative variance";
  }
  return std::nullopt;
}

}  // namespace

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
  message.keypoints(to_messages(landmark.keypoints));
  message.thumbnail(landmark.thumbnail);
  return message;
}

conversions::Result<PanoramicLandmark> to_landmark(const panvo_msgs::msg::PanoramicLandmark& message,
                                                   const DescriptionSettings& settings) {
  if (const auto found = differences(settings_from_text(message.settings()), settings); !found.empty()) {
    std::string reason = "was described in another way: ";
    for (std::size_t i = 0; i < found.size(); ++i) reason += (i == 0 ? "" : "; ") + found[i];
    return Reason{reason};
  }
  if (message.id() == 0) return Reason{"has no id"};
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
  auto wrong = wrong_with_covariance(landmark.covariance);
  if (!wrong) wrong = wrong_with_histogram(landmark.description.histogram);
  if (!wrong) wrong = read(message.large_features(), "large_features", landmark.description.large);
  if (!wrong) wrong = read(message.small_features(), "small_features", landmark.description.small);
  if (!wrong) wrong = read(message.keypoints(), landmark.keypoints);
  if (wrong) return Reason{*wrong};
  return landmark;
}

conversions::Result<std::vector<LandmarkPose>> to_landmark_poses(const panvo_msgs::msg::LandmarkPoses& message) {
  if (message.ids().size() != message.poses().size()) {
    return Reason{"has " + std::to_string(message.ids().size()) + " ids, but " +
                  std::to_string(message.poses().size()) + " poses"};
  }
  std::vector<LandmarkPose> poses;
  poses.reserve(message.ids().size());
  for (std::size_t i = 0; i < message.ids().size(); ++i) {
    const auto where = " in poses[" + std::to_string(i) + "]";
    const auto pose = conversions::to_isometry(message.poses()[i].pose());
    if (!pose) return Reason{pose.reason() + where};
    if (message.ids()[i] == 0) return Reason{"has an id that is 0" + where};
    const LandmarkPose moved{message.ids()[i], *pose, conversions::to_matrix(message.poses()[i].covariance())};
    if (const auto wrong = wrong_with_covariance(moved.covariance)) return Reason{*wrong + where};
    poses.push_back(moved);
  }
  return poses;
}

}  // namespace panvo::landmarks

// SPDX-License-Identifier: Apache-2.0
#include "landmark_rules.hpp"

#include <Eigen/Geometry>
#include <span>

#include "panvo/interfaces/place_rules.hpp"

namespace panvo::landmarks {
namespace {

using interfaces::Check;

void check_isometry(Check& check, std::string_view name, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d position = pose.translation();
  check.bounded({name, "position"}, std::span<const double>(position.data(), 3), interfaces::kMaxCoordinate_m);
  const Eigen::Matrix3d rotation = pose.linear();
  const double deviation = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  check.require(deviation <= interfaces::kUnitTolerance, {name, "orientation"}, "is not a rotation");
}

void check_landmark_pose(Check& check, const Eigen::Isometry3d& map_from_base,
                         const Eigen::Matrix<double, 6, 6>& covariance) {
  check_isometry(check, "pose.pose", map_from_base);
  // The storage order does not matter: an asymmetric matrix is rejected anyway.
  check.covariance("pose.covariance", std::span<const double>(covariance.data(), 36));
}

void check_features(Check& check, std::string_view name, const std::vector<AdaptiveFeature>& features,
                    const interfaces::DescriptionSize& size) {
  interfaces::FeatureRule rule(check, name, features.size(), size);
  for (const auto& feature : features) {
    if (!check.holds()) return;
    rule.check(feature.row, feature.value, feature.scale, feature.weight);
  }
}

std::array<float, 3> to_array(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

void check_keypoints(Check& check, const std::vector<Keypoint>& keypoints) {
  check.at_most("keypoints", keypoints.size(), interfaces::kMaxKeypoints);
  for (const auto& keypoint : keypoints) {
    if (!check.holds()) return;
    interfaces::check_keypoint(check, to_array(keypoint.bearing), keypoint.size_px, keypoint.has_point,
                               to_array(keypoint.point_in_panorama), keypoint.inverse_range_sigma);
  }
}

}  // namespace

std::optional<std::string> problem_of(const PanoramicLandmark& landmark, const DescriptionSettings& settings) {
  Check check;
  check.require(landmark.id <= interfaces::kMaxLandmarkId, "id", "is above 4000000000");
  check_landmark_pose(check, landmark.map_from_base, landmark.covariance);
  check_isometry(check, "panorama_pose", landmark.base_from_panorama);
  const auto size = interfaces::description_size(to_text(settings));
  check_histogram(check, landmark.description.histogram, size);
  check_features(check, "large_features", landmark.description.large, size);
  check_features(check, "small_features", landmark.description.small, size);
  check_keypoints(check, landmark.keypoints);
  check.at_most("thumbnail", landmark.thumbnail.size(), interfaces::kMaxThumbnail);
  return check.problem();
}

std::optional<std::string> problem_of_pose(const Eigen::Isometry3d& map_from_base,
                                           const Eigen::Matrix<double, 6, 6>& covariance) {
  Check check;
  check_landmark_pose(check, map_from_base, covariance);
  return check.problem();
}

std::optional<std::string> problem_of(const std::vector<Keypoint>& keypoints) {
  Check check;
  check_keypoints(check, keypoints);
  return check.problem();
}

}  // namespace panvo::landmarks

// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/pose_error.hpp"

#include <cmath>
#include <numbers>

namespace panvo::evaluation {

std::vector<double> distances_m(std::span<const PosePair> pairs) {
  std::vector<double> distances;
  distances.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    distances.push_back(
        i == 0 ? 0.0
               : distances.back() +
                     (pairs[i].map_from_base.translation() - pairs[i - 1].map_from_base.translation()).norm());
  }
  return distances;
}

std::vector<PoseError> pose_errors(std::span<const PosePair> pairs, const MapFromOdom& map_from_odom) {
  const std::vector<double> distances = distances_m(pairs);
  std::vector<PoseError> errors;
  errors.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Isometry3d& truth = pairs[i].map_from_base;
    const Eigen::Isometry3d estimate = map_from_odom * pairs[i].odom_from_base;
    const Eigen::Matrix3d turn = estimate.linear() * truth.linear().transpose();
    PoseError error;
    error.stamp_ns = pairs[i].stamp_ns;
    error.distance_m = distances[i];
    error.ground_truth_m = truth.translation();
    error.estimate_m = estimate.translation();
    error.translation_m = estimate.translation() - truth.translation();
    error.rotation_rad = rotation_vector(turn);
    error.yaw_rad = std::atan2(turn(1, 0), turn(0, 0));
    errors.push_back(error);
  }
  return errors;
}

std::optional<Summary> absolute_trajectory_error(std::span<const PoseError> errors) {
  std::vector<double> lengths_m;
  for (const PoseError& error : errors) lengths_m.push_back(error.translation_m.norm());
  return summarize(std::move(lengths_m));
}

std::optional<Summary> absolute_rotation_error_deg(std::span<const PoseError> errors) {
  std::vector<double> angles_deg;
  for (const PoseError& error : errors) angles_deg.push_back(error.rotation_rad.norm() * 180.0 / std::numbers::pi);
  return summarize(std::move(angles_deg));
}

}  // namespace panvo::evaluation

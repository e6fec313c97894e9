// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "panvo/evaluation/alignment.hpp"
#include "panvo/evaluation/association.hpp"
#include "panvo/evaluation/statistics.hpp"

namespace panvo::evaluation {

// Error of one aligned pose, estimate minus ground truth, in the world frame of the ground truth.
struct PoseError {
  std::int64_t stamp_ns = 0;
  double distance_m = 0.0;         // travelled so far, from the ground truth
  Eigen::Vector3d ground_truth_m;  // position
  Eigen::Vector3d estimate_m;      // position, aligned
  Eigen::Vector3d translation_m;   // error
  Eigen::Vector3d rotation_rad;    // rotation vector from the true orientation to the estimated one
  double yaw_rad = 0.0;            // its heading part, left positive, in (-pi, pi]
};

// Distance travelled up to each pair, from the ground truth, m.
std::vector<double> distances_m(std::span<const PosePair> pairs);

// One error per pair.
std::vector<PoseError> pose_errors(std::span<const PosePair> pairs, const MapFromOdom& map_from_odom);

// Absolute trajectory error: norm of the translation error, m.
std::optional<Summary> absolute_trajectory_error(std::span<const PoseError> errors);

// Absolute rotation error, degrees.
std::optional<Summary> absolute_rotation_error_deg(std::span<const PoseError> errors);

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::binocular_odometry {

/// One point in two frames: u, v, disparity (px). The disparity in the current frame may be missing. `vote` is its
/// weight relative to points that are known to be static.
struct PointPair {
  Eigen::Vector3d previous;
  Eigen::Vector3d current;
  bool has_current_disparity = false;
  double vote = 1.0;
};

struct RansacResult {
  Eigen::Isometry3d current_from_previous;
  std::vector<bool> is_inlier;  ///< per pair
  int inliers = 0;
};

/// Camera motion between two frames by RANSAC [Fischler and Bolles 1981]: rigid motions of point triples with Horn's
/// quaternion method [Lu2015 3], scored by the reprojection errors of all points. Each new best motion is refined on
/// its inliers. `guesses`, e.g. the predicted motion, are scored first. `parameters`: iterations, threshold and seed.
/// Deterministic. Returns nullopt if no motion has three inliers.
std::optional<RansacResult> estimate_motion(const vision::RectifiedStereo& stereo, std::span<const PointPair> pairs,
                                            std::span<const Eigen::Isometry3d> guesses,
                                            const MotionParameters& parameters);

}  // namespace panvo::binocular_odometry

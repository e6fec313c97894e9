// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "panvo/vision/camera.hpp"

namespace panvo::binocular_odometry {

/// One point in two frames: u, v, disparity (px). The disparity in the current frame may be missing. `vote` is how much it counts in
/// judging a motion, against those that are known to stand still.
struct PointPair {
  Eigen::Vector3d previous;
  Eigen::Vector3d current;
  bool has_current_disparity = false;
  double vote = 1.0;
};

struct RansacOptions {
  int max_iterations = 100;
  double threshold_px = 2.0;
  std::uint32_t seed = 1;
};

struct RansacResult {
  Eigen::Isometry3d current_from_previous;
  std::vector<bool> is_inlier;  ///< one for each pair
  int inliers = 0;
};

/// Motion of the camera between two frames by random sample consensus [Fischler and Bolles 1981]: rigid motions of triples of
/// points by Horn's quaternion method [Lu2015 3], judged by the reprojection of all. Each new best is improved over its
/// inliers. `guesses` are tried before any triple (a motion carried on is often nearly right, and costs nothing).
/// The same input gives the same result. nullopt when no motion has three inliers.
std::optional<RansacResult> estimate_motion(const vision::RectifiedStereo& stereo, std::span<const PointPair> pairs,
                                            std::span<const Eigen::Isometry3d> guesses, const RansacOptions& options);

}  // namespace panvo::binocular_odometry

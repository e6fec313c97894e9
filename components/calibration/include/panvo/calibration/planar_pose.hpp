// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// Bearing of a pixel in the camera frame; nullopt if the lens model has none.
using Unproject = std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector2d&)>;

/// Linear estimate of the pose camera_from_board of a flat board from the bearings of its corners: direction x (r1 X +
/// r2 Y + t) = 0 [Zhang 2000, on the sphere instead of the image plane, so that lenses may be wider than 180 degrees].
/// Initial value for a refinement. Returns nullopt for fewer than four corners, or if all but one are collinear.
std::optional<Eigen::Isometry3d> planar_pose(const std::vector<Corner>& corners,
                                             const std::vector<Eigen::Vector3d>& board_points,
                                             const Unproject& unproject);

}  // namespace panvo::calibration

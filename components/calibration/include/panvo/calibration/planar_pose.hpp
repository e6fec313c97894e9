// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <vector>

#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// Direction of a pixel in the camera's frame; nullopt: the lens shows nothing there.
using Unproject = std::function<std::optional<Eigen::Vector3d>(const Eigen::Vector2d&)>;

/// Pose camera_from_board of a flat board from the directions in which its corners are seen, by the linear solution of
/// direction x (r1 X + r2 Y + t) = 0 [Zhang 2000, on the sphere instead of the image plane, so that lenses may be wider than 180 degrees]. A
/// start for a refinement. nullopt: fewer than four corners, or all on one line.
std::optional<Eigen::Isometry3d> planar_pose(const std::vector<Corner>& corners,
                                             const std::vector<Eigen::Vector3d>& board_points,
                                             const Unproject& unproject);

}  // namespace panvo::calibration

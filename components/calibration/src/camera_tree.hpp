// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace panvo::calibration {

/// Poses camera_from_board, by camera and view; nullopt: not seen.
using BoardPoses = std::vector<std::vector<std::optional<Eigen::Isometry3d>>>;

/// Pose camera_from_reference of each camera, chained along the pairs that share most views. Throws CalibrationError
/// for cameras that share no view with a connected camera. `names`: of the cameras.
std::vector<Eigen::Isometry3d> join_cameras(const BoardPoses& poses, std::size_t reference,
                                            const std::vector<std::string>& names);

}  // namespace panvo::calibration

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace panvo::vision {

/// Rigid motion that takes points in frame b nearest to the same points in frame a, in the least-squares sense: the
/// closed-form solution with unit quaternions, the rotation being the eigenvector of the largest eigenvalue of a symmetric
/// 4x4 matrix [Horn 1987, Closed-form solution of absolute orientation using unit quaternions].
/// Spans of equal length, metres. nullopt for fewer than three points or points on one line.
std::optional<Eigen::Isometry3d> absolute_orientation(std::span<const Eigen::Vector3d> points_in_a,
                                                      std::span<const Eigen::Vector3d> points_in_b);

}  // namespace panvo::vision

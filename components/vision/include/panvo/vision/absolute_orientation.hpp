// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace panvo::vision {

/// Least-squares rigid motion a_from_b between corresponding points, in closed form with unit quaternions: the rotation
/// is the eigenvector of the largest eigenvalue of a symmetric 4x4 matrix [Horn 1987, Closed-form solution of absolute
/// orientation using unit quaternions]. Points in metres. Returns nullopt for spans of different length, fewer than
/// three points or collinear points.
std::optional<Eigen::Isometry3d> absolute_orientation(std::span<const Eigen::Vector3d> points_in_a,
                                                      std::span<const Eigen::Vector3d> points_in_b);

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/vision/camera.hpp"

/// Geometry of a rectified pair. A point is seen as (u, v, d): column and row in the left image and disparity
/// d = u_left - u_right, all in px. Points are in the left rectified optical frame, metres.
namespace panvo::vision {

/// What the pair sees of a point with z > 0.
Eigen::Vector3d observe(const RectifiedStereo& stereo, const Eigen::Vector3d& point_in_left);

/// The point seen at (u, v, d); nullopt for a disparity that is not positive (at or beyond infinity, or no number).
std::optional<Eigen::Vector3d> triangulate(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px);

/// Covariance (m^2) of a triangulated point, to first order in independent errors of u, v and d (standard deviations, px).
Eigen::Matrix3d triangulation_covariance(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px,
                                         const Eigen::Vector3d& sigma_px);

/// Homogeneous point (x/z, y/z, 1/z) of an observation, finite also at infinity (d = 0).
Eigen::Vector3d inverse_depth_point(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px);

/// Plane n (1/m) with n . X = 1 for the points X of the surface around an observation, given the disparity's gradient
/// there (px per px along u and v): over a plane the disparity is linear in the pixel.
Eigen::Vector3d surface_plane(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px,
                              const Eigen::Vector2d& disparity_gradient);

/// The other way round: the disparity gradient of a plane.
Eigen::Vector2d disparity_gradient(const RectifiedStereo& stereo, const Eigen::Vector3d& plane);

/// The plane's coordinates in another frame; nullopt when that frame's origin lies on it or behind it.
std::optional<Eigen::Vector3d> transform_plane(const Eigen::Isometry3d& b_from_a, const Eigen::Vector3d& plane_in_a);

}  // namespace panvo::vision

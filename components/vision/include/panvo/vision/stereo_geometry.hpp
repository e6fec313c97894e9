// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/vision/camera.hpp"

/// Geometry of a rectified pair. An observation is (u, v, d): column and row in the left image and disparity
/// d = u_left - u_right, all in px. Points are in the left rectified optical frame, in metres.
namespace panvo::vision {

/// Observation of a point with z > 0.
Eigen::Vector3d observe(const RectifiedStereo& stereo, const Eigen::Vector3d& point_in_left);

/// Point of an observation; nullopt unless the disparity is positive.
std::optional<Eigen::Vector3d> triangulate(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px);

/// First-order covariance (m^2) of a triangulated point for independent errors of u, v and d with standard deviations
/// `sigma_px`.
Eigen::Matrix3d triangulation_covariance(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px,
                                         const Eigen::Vector3d& sigma_px);

/// Inverse-depth coordinates (x/z, y/z, 1/z) of an observation; also finite for points at infinity (d = 0).
Eigen::Vector3d inverse_depth_point(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px);

/// Tangent plane n (1/m) of the surface at an observation, n . X = 1 for its points X, from the disparity gradient (px
/// per px along u and v). The disparity of a plane is linear in the pixel coordinates.
Eigen::Vector3d surface_plane(const RectifiedStereo& stereo, const Eigen::Vector3d& observation_px,
                              const Eigen::Vector2d& disparity_gradient);

/// Disparity gradient of a plane; the inverse of surface_plane().
Eigen::Vector2d disparity_gradient(const RectifiedStereo& stereo, const Eigen::Vector3d& plane);

/// Transforms a plane to another frame; nullopt if the origin of that frame lies on or behind the plane.
std::optional<Eigen::Vector3d> transform_plane(const Eigen::Isometry3d& b_from_a, const Eigen::Vector3d& plane_in_a);

}  // namespace panvo::vision

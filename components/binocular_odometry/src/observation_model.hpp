// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "panvo/vision/camera.hpp"

/// Observation model of a rectified pair for a point p = (x/z, y/z, 1/z) in an anchor frame. With h = R (p_x, p_y, 1) +
/// p_z t, the point in the camera frame times p_z, the pixel is the projection of h and the disparity is f b p_z / h_z:
/// finite and smooth even at infinity (p_z = 0).
namespace panvo::binocular_odometry {

/// u, v, disparity (px) of a point; nullopt if it is not in front of the camera.
std::optional<Eigen::Vector3d> predict(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_anchor,
                                       const Eigen::Vector3d& inverse_depth_point);

struct Prediction {
  Eigen::Vector3d pixel;
  Eigen::Matrix3d by_point;             ///< derivative with respect to inverse_depth_point
  Eigen::Matrix<double, 3, 6> by_pose;  ///< derivative with respect to e in exp(e) * left_from_anchor
};

/// As predict(), with derivatives.
std::optional<Prediction> predict_with_jacobians(const vision::RectifiedStereo& stereo,
                                                 const Eigen::Isometry3d& left_from_anchor,
                                                 const Eigen::Vector3d& inverse_depth_point);

}  // namespace panvo::binocular_odometry

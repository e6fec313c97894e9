// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "panvo/vision/camera.hpp"

/// How a rectified pair sees a point that is written as p = (x/z, y/z, 1/z) in an anchor frame. With h = R (p_x, p_y, 1) + p_z t,
/// the point in the camera's frame times p_z, the pixel is that of h and the disparity f b p_z / h_z: finite and smooth
/// also for points at infinity (p_z = 0).
namespace panvo::binocular_odometry {

/// u, v, disparity (px) of a point; nullopt when it is not in front of the camera.
std::optional<Eigen::Vector3d> predict(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_anchor,
                                       const Eigen::Vector3d& inverse_depth_point);

struct Prediction {
  Eigen::Vector3d pixel;
  Eigen::Matrix3d by_point;             ///< derivative by inverse_depth_point
  Eigen::Matrix<double, 3, 6> by_pose;  ///< derivative by e in exp(e) * left_from_anchor
};

/// The same with its derivatives.
std::optional<Prediction> predict_with_jacobians(const vision::RectifiedStereo& stereo,
                                                 const Eigen::Isometry3d& left_from_anchor,
                                                 const Eigen::Vector3d& inverse_depth_point);

}  // namespace panvo::binocular_odometry

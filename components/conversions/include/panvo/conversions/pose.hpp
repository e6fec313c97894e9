// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "geometry_msgs/msg/Pose.h"
#include "geometry_msgs/msg/Transform.h"
#include "geometry_msgs/msg/Vector3.h"
#include "panvo/conversions/result.hpp"
#include "panvo/vision/pose.hpp"

/// Conversion of vectors, poses and covariances. The Pose of frame b in frame a, and the Transform from parent a to child b, are
/// a_from_b.
namespace panvo::conversions {

geometry_msgs::msg::Vector3 to_vector3(const Eigen::Vector3d& vector);
Eigen::Vector3d to_eigen(const geometry_msgs::msg::Vector3& vector);

geometry_msgs::msg::Pose to_pose(const Eigen::Isometry3d& a_from_b);
geometry_msgs::msg::Transform to_transform(const Eigen::Isometry3d& parent_from_child);

/// The reason states non-finite values or a quaternion that is not of length 1 (0: never filled in).
Result<Eigen::Isometry3d> to_isometry(const geometry_msgs::msg::Pose& pose);
Result<Eigen::Isometry3d> to_isometry(const geometry_msgs::msg::Transform& transform);

/// Row-major, translation before rotation: geometry_msgs and vision use the same order.
std::array<double, 36> to_array(const vision::Matrix6d& covariance);
vision::Matrix6d to_matrix(const std::array<double, 36>& covariance);

}  // namespace panvo::conversions

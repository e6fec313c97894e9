// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/binocular_odometry/odometry_estimate.hpp"
#include "panvo/binocular_odometry/scene_point.hpp"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "sensor_msgs/msg/PointCloud2.h"
#include "tf2_msgs/msg/TFMessage.h"
#include "vehicle_motion.hpp"

namespace panvo::binocular_odometry {

/// Converts an estimate to ROS conventions (REP 103, REP 105): pose of `base_frame` in `odom_frame`, the base_frame of
/// the first image; mean twist since `previous_stamp_ns` in the axes of base_frame, zero with a large covariance
/// if it is unknown: for the first estimate (nullopt), and after a clock that was set back. Covariances are transformed.
nav_msgs::msg::Odometry to_odometry(const VehicleEstimate& estimate, std::optional<std::int64_t> previous_stamp_ns,
                                    const std::string& odom_frame, const std::string& base_frame);

/// The pose of an odometry message as a transform.
tf2_msgs::msg::TFMessage to_transform(const nav_msgs::msg::Odometry& odometry);

/// Points, given in the axes of the start, in odom_frame with the fields x, y, z (m; NaN if unknown), u, v (px, left
/// rectified image), track and state (ScenePoint::State).
sensor_msgs::msg::PointCloud2 to_point_cloud(const std::vector<ScenePoint>& points,
                                             const Eigen::Isometry3d& odom_from_start, std::int64_t stamp_ns,
                                             const std::string& odom_frame);

panvo_msgs::msg::OdometryQuality to_quality(const OdometryEstimate& estimate, const std::string& base_frame);

}  // namespace panvo::binocular_odometry

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/conversions/odometry_join.hpp"
#include "panvo/conversions/result.hpp"
#include "panvo/odometry_fusion/odometry_fusion.hpp"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "sensor_msgs/msg/Imu.h"

/// Conversions between messages and the fusion's data. Reasons are sentences without a subject.
namespace panvo::odometry_fusion {

conversions::Result<GyroSample> to_gyro(const sensor_msgs::msg::Imu& message, const Eigen::Isometry3d& base_from_imu);

/// `base_from_wheels`: the frame of the velocity on the vehicle.
conversions::Result<WheelSample> to_wheels(std::int64_t stamp_ns, const geometry_msgs::msg::TwistWithCovariance& twist,
                                           const Eigen::Isometry3d& base_from_wheels);

/// `frames`: gives their names.
nav_msgs::msg::Odometry to_odometry(const FusedPose& fused, const nav_msgs::msg::Odometry& frames);

panvo_msgs::msg::OdometryQuality to_quality(const FusedPose& fused, const conversions::OdometryJoin::Quality& of_stereo,
                                            const std::string& base_frame);

}  // namespace panvo::odometry_fusion

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "panvo/odometry_fusion/fusion_parameters.hpp"
#include "panvo/odometry_fusion/motion_filter.hpp"
#include "panvo/odometry_fusion/sensor_data.hpp"

/// Each sensor's measurement of the motion in an interval, and its errors.
namespace panvo::odometry_fusion {

/// Motion between two stereo poses with its own covariance: true = (1 + scale) measured.
Factor stereo_factor(const MotionFilter& filter, const Eigen::Isometry3d& measured, const vision::Matrix6d& covariance);

/// Integrated rotation: true rate = mounting * (measured - bias) / (1 + scale). `samples` span the interval.
Factor gyro_factor(const MotionFilter& filter, std::span<const GyroSample> samples, const GyroParameters& parameters);

/// Integrated distance along the arc that the filter's rotation describes, no motion to the side except by the distance
/// from the axle, none upwards; with `has_yaw`, also the rotation: as measured about z, little about x and y.
Factor wheel_factor(const MotionFilter& filter, std::span<const WheelSample> samples, const WheelParameters& parameters,
                    bool has_yaw);

/// No translation.
Factor standstill_factor(const MotionFilter& filter);

/// Integrals of the raw samples.
Eigen::Vector3d rotation_of(std::span<const GyroSample> samples);  ///< rad; small-angle sum
struct WheelMotion {
  double forward_m = 0.0, left_m = 0.0, yaw_rad = 0.0;
};
WheelMotion motion_of(std::span<const WheelSample> samples);

}  // namespace panvo::odometry_fusion

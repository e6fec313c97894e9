// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "panvo/odometry_fusion/sensor_data.hpp"

namespace panvo::odometry_fusion {

/// Time for which sensors must show no motion. A wheel that turns by less than an encoder's tick in it counts as still.
inline constexpr double kStill_s = 0.5;

/// Whether wheels show no motion throughout `samples`.
bool is_still(std::span<const WheelSample> samples);

/// Whether the rates are constant and, within `bias_sigma_rad_s`, those of a gyroscope at rest. The vibration of a
/// moving vehicle is not.
bool is_still(std::span<const GyroSample> samples, const Eigen::Vector3d& bias_rad_s, double bias_sigma_rad_s);

}  // namespace panvo::odometry_fusion

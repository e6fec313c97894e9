// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

/// Why a pose with this covariance (as of vision::pose_error) cannot be computed with: numbers that are none, a rotation that is none, a
/// position farther than 10,000 km, a covariance that is not symmetric and positive semidefinite or has a variance above 1e12. Nullopt when it can.
std::optional<std::string> fault_of(const Eigen::Isometry3d& pose, const vision::Matrix6d& covariance);

/// The same of a measured angle: finite, of three turns at most, with a variance between 1e-12 and 1e4 rad^2.
std::optional<std::string> fault_of_angle(double angle_rad, double variance_rad2);

}  // namespace panvo::localizer

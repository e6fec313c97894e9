// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

/// Reason why a pose and its covariance (as vision::pose_error) are invalid: values that are not finite, an invalid
/// rotation, a position beyond 10,000 km, a covariance that is not symmetric and positive semidefinite or has a
/// variance above 1e12. nullopt if valid.
std::optional<std::string> fault_of(const Eigen::Isometry3d& pose, const vision::Matrix6d& covariance);

/// The same for a measured angle: finite, at most three turns, variance between 1e-12 and 1e4 rad^2.
std::optional<std::string> fault_of_angle(double angle_rad, double variance_rad2);

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {

/// A point of the landmark, in its panorama's frame, and the bearing at which it is seen now.
struct SightedPoint {
  Eigen::Vector3d point;       ///< m
  Eigen::Matrix3d covariance;  ///< of the point, m^2
  Eigen::Vector3d bearing;     ///< unit, frame of the panorama now
};

struct RefinedPose {
  Eigen::Isometry3d landmark_from_panorama = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< as of vision::pose_error; wider where residuals say so
  double mean_square = 0.0;  ///< of the whitened residuals, per degree of freedom: 1 where the sigmas are true
};

/// Squared residual of a sighting in units of its variance, two degrees of freedom; infinite for a point behind the bearing.
double squared_residual(const SightedPoint& sighting, const Eigen::Isometry3d& landmark_from_panorama,
                        double bearing_sigma_rad);

/// The pose that fits the bearings best: Gauss-Newton with damping over the angles between bearings and points, robust
/// (Cauchy). At least three sightings. The covariance is that of the minimum, zero information meaning infinite variance is not
/// returned: a pose that its points do not determine keeps the start and gets 1e6 on the diagonal.
RefinedPose refine_pose(const Eigen::Isometry3d& start, std::span<const SightedPoint> sightings,
                        double bearing_sigma_rad);

}  // namespace panvo::position_corrector

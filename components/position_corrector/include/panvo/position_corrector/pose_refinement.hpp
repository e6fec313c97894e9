// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "panvo/vision/pose.hpp"

namespace panvo::position_corrector {

/// A point in the frame of the landmark's panorama, and its current bearing.
struct SightedPoint {
  Eigen::Vector3d point;       ///< m
  Eigen::Matrix3d covariance;  ///< of the point, m^2
  Eigen::Vector3d bearing;     ///< unit, frame of the current panorama
};

struct RefinedPose {
  Eigen::Isometry3d landmark_from_panorama = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< as vision::pose_error; inflated by large residuals
  double mean_square = 0.0;  ///< of the whitened residuals, per degree of freedom: 1 if the sigmas are correct
};

/// Squared residual of a sighting in units of its variance, two degrees of freedom; infinite for a point behind the
/// camera.
double squared_residual(const SightedPoint& sighting, const Eigen::Isometry3d& landmark_from_panorama,
                        double bearing_sigma_rad);

/// The pose that best fits the bearings: damped Gauss-Newton over the angles between bearings and points, robust
/// (Cauchy). A pose that its points do not determine (fewer than four, or degenerate) keeps the start and gets 1e6 on
/// the diagonal of its covariance.
RefinedPose refine_pose(const Eigen::Isometry3d& start, std::span<const SightedPoint> sightings,
                        double bearing_sigma_rad);

/// Covariance of a refined pose if its `spare` most informative sightings were false. A near point that is false can
/// determine a position alone, among far ones, and then leaves no residual by which it would be noticed.
vision::Matrix6d covariance_without_most_informative(const RefinedPose& refined,
                                                     std::span<const SightedPoint> sightings, double bearing_sigma_rad,
                                                     int spare);

}  // namespace panvo::position_corrector

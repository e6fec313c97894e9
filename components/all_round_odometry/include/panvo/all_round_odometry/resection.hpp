// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "panvo/all_round_odometry/panorama_points.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::all_round_odometry {

/// Inverse of the distance of a point from the reference camera, 1/m. By inverse distances, a point at infinity is as
/// good as a near one, and errors are about normal [Civera2008].
struct InverseDistance {
  double mean = 0.05;
  double variance = 0.1 * 0.1;  ///< the default covers all distances from 5 m to infinity
};

/// A sighting compared with where a camera pose expects it, along azimuth and elevation at the sighting.
struct Residual {
  Eigen::Vector2d error;                   ///< rad, expected minus seen
  Eigen::Matrix<double, 2, 6> by_pose;     ///< derivative by the pose error as of vision::pose_error
  Eigen::Vector2d by_inverse;              ///< derivative by the inverse distance
  Eigen::Matrix2d measurement_covariance;  ///< of the sighting alone
};

/// `then_from_now`: pose of the camera at the sighting. nullopt if the point would be inside the camera.
std::optional<Residual> residual_of(const Sighting& sighting, double inverse_m, const Eigen::Isometry3d& then_from_now);

/// A sighting with what is known of the point.
struct KnownSighting {
  const Sighting* sighting;
  InverseDistance inverse;
  const Eigen::Isometry3d* then_from_local;  ///< inverse pose of the camera at its reference
};

struct Resection {
  Eigen::Isometry3d local_from_now = Eigen::Isometry3d::Identity();  ///< of the camera
  vision::Matrix6d covariance = vision::Matrix6d::Zero();            ///< as vision::pose_error
  int agreeing = 0;                                                  ///< points
};

/// Finds the camera pose from bearings of points whose distances are known to different degrees: a point of unknown
/// distance contributes to the rotation and to the direction of motion, one of known distance to the position, too.
/// Robust (Cauchy loss) against moving objects. Returns nullopt if the equations are singular or do not converge from
/// `start`.
std::optional<Resection> resect(std::span<const KnownSighting> points, const Eigen::Isometry3d& start);

}  // namespace panvo::all_round_odometry

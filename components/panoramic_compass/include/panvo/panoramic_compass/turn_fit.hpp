// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace panvo::panoramic_compass {

/// Bearings of a point in two panoramas: unit vectors in the vehicle axes (x forward, y left, z up) at each time.
struct BearingPair {
  Eigen::Vector3d then;
  Eigen::Vector3d now;
  Eigen::Vector2d variance_rad2;  ///< of `now`, along azimuth (great-circle angle) and elevation
  int id = 0;                     ///< of the point in its reference panorama
};

/// Motion supported by most points.
struct TurnFit {
  Eigen::Matrix3d now_from_then = Eigen::Matrix3d::Identity();
  Eigen::Vector3d drift =
      -Eigen::Vector3d::
          UnitX();       ///< unit vector in the axes at `now`: apparent motion of near points, opposite to travel
  double yaw_rad = 0.0;  ///< yaw of the vehicle, now minus then, left positive
  double yaw_variance_rad2 = 0.0;  ///< from the agreement of the points
  double drift_azimuth_variance_rad2 =
      1.0;                        ///< of the drift azimuth, from the agreement of the points; about 1 at standstill
  double typical_parallax = 0.0;  ///< rad, median of travelled distance / point distance
  /// About half that of the nearer points, rad: they tell the direction of travel even if most points are far, as in
  /// open land.
  double near_parallax = 0.0;
  int agreeing = 0;          ///< number of agreeing points
  std::vector<bool> agrees;  ///< per pair
};

/// Fits rotation and direction of motion to points at all azimuths and unknown distances. Each point must lie on the
/// great circle from its position predicted by the rotation towards the drift direction; its deviation across the
/// circle is the residual. Parallax beside the vehicle is therefore not mistaken for a turn, effects of sideways motion
/// at front and rear cancel, and moving objects disagree. At standstill, the displacement along the circles is used as
/// well. Robust (Cauchy loss); needs an approximate rotation, and tries `start_drift` first. Returns nullopt for fewer
/// than 6 pairs or without convergence.
std::optional<TurnFit> fit_turn(std::span<const BearingPair> pairs, const Eigen::Matrix3d& start_now_from_then,
                                const Eigen::Vector3d& start_drift = -Eigen::Vector3d::UnitX());

}  // namespace panvo::panoramic_compass

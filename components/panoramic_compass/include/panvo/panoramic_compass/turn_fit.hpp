// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace panvo::panoramic_compass {

/// A point as two panoramas show it: unit vectors in the vehicle's axes (x forward, y left, z up) at either time.
struct BearingPair {
  Eigen::Vector3d then;
  Eigen::Vector3d now;
  Eigen::Vector2d variance_rad2;  ///< of `now`, along azimuth (on the great circle) and along elevation
};

/// The motion that most points agree on.
struct TurnFit {
  Eigen::Matrix3d now_from_then = Eigen::Matrix3d::Identity();
  Eigen::Vector3d drift =
      -Eigen::Vector3d::UnitX();   ///< unit vector now: where near things move to, against the way driven
  double yaw_rad = 0.0;            ///< the vehicle's, now minus then, left positive
  double yaw_variance_rad2 = 0.0;  ///< by how well the points agree
  double drift_azimuth_variance_rad2 =
      1.0;                        ///< of the drift, about the upward axis, the same; about 1 where nothing moves
  double typical_parallax = 0.0;  ///< rad, way / distance of the points, median
  int agreeing = 0;               ///< points
  std::vector<bool> agrees;       ///< of each pair
};

/// Rotation and direction of motion together, from points at all azimuths and at unknown distances. Each point may lie anywhere on
/// the great circle from where the rotation alone puts it to the direction of drift, and only forward along it; how far across the
/// circle it lies is what counts. So near things beside the vehicle do not pass for a turn, front and rear cancel what a
/// motion to the side does, and what moves by itself disagrees. When the vehicle stands, nothing lies along the circles either, and
/// that counts, too. Robust (Cauchy), from a rotation that is about right; the direction
/// of drift is what is tried first. nullopt for fewer than 6 pairs or where nothing converges.
std::optional<TurnFit> fit_turn(std::span<const BearingPair> pairs, const Eigen::Matrix3d& start_now_from_then,
                                const Eigen::Vector3d& start_drift = -Eigen::Vector3d::UnitX());

}  // namespace panvo::panoramic_compass

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "panvo/panoramic_compass/turn_fit.hpp"

namespace panvo::panoramic_compass {

using Vector5d = Eigen::Matrix<double, 5, 1>;

/// State of the fit: rotation and drift direction; the latter is parametrised along two tangents.
struct Motion {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d drift;

  std::array<Eigen::Vector3d, 2> tangents() const {
    const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(drift).normalized();
    return {level, drift.cross(level)};
  }
  /// Rotated by step(0..2), with the drift turned along both tangents.
  Motion moved(const Vector5d& step) const;
};

inline double yaw_of(const Motion& motion) { return std::atan2(motion.rotation(0, 1), motion.rotation(0, 0)); }
inline double azimuth_of(const Motion& motion) { return std::atan2(motion.drift.y(), motion.drift.x()); }

/// Deviation of a point from its great circle.
struct Deviation {
  double across = 0.0, along = 0.0;                    // rad
  double across_variance = 1.0, along_variance = 1.0;  // of the measurement
  double sine = 0.0;                                   // of the angle to the drift direction
  Eigen::Vector3d normal;                              // of the plane of the circle
  Eigen::Vector3d lever;                               // lever arm of the derivatives
  Eigen::Vector3d predicted;                           // position of a far point
};

/// nullopt for a point too near the drift direction, where its great circle is undefined.
std::optional<Deviation> deviation_of(const BearingPair& pair, const Motion& motion);

/// Chooses the sign of the drift so that near points move towards it.
void orient(std::span<const BearingPair> pairs, Motion& motion);

/// Squared deviation across the great circle or backwards along it, whichever is larger, in standard deviations
/// squared.
double disagreement(const Deviation& d, double noise);
inline constexpr double kAgreeing = 3.0 * 3.0;  ///< of a point that agrees

/// Truncated sum over all points; unlike the cost of a fit, comparable between motions.
double total_disagreement(std::span<const BearingPair> pairs, const Motion& motion, double noise);

}  // namespace panvo::panoramic_compass

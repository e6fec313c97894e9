// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/epipolar_refinement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"

namespace panvo::position_corrector {
namespace {

constexpr int kSteps = 10;
constexpr double kEpipolarLossScale = 2.5;  // standard deviations
constexpr double kMinNormal = 1e-9;         // both bearings along the baseline: on every epipolar plane

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Basis = Eigen::Matrix<double, 3, 2>;

/// Two directions perpendicular to the baseline, as columns.
Basis across_baseline(const Eigen::Vector3d& direction) {
  Basis basis;
  basis.col(0) = direction.unitOrthogonal();
  basis.col(1) = direction.cross(basis.col(0));
  return basis;
}

struct WhitenedDistance {
  double residual = 0.0;
  Vector5d jacobian = Vector5d::Zero();  // by the rotation error (landmark axes) and the direction error across it
};

/// Distance of a pair from its epipolar plane, in standard deviations of both bearings.
WhitenedDistance whitened_distance(const BearingPair& pair, const EpipolarMotion& motion, const Basis& basis,
                                   double sigma_rad) {
  const Eigen::Vector3d turned = motion.rotation * pair.panorama;
  const Eigen::Vector3d normal_of_landmark = pair.landmark.cross(motion.direction);
  const Eigen::Vector3d normal_of_panorama = motion.direction.cross(turned);
  const double residual = pair.landmark.dot(normal_of_panorama);
  // derivative of the residual by perpendicular motion of the bearings
  const double slope2 = normal_of_panorama.squaredNorm() + normal_of_landmark.squaredNorm() - 2.0 * residual * residual;
  WhitenedDistance result;
  if (slope2 < kMinNormal) return result;
  const double scale = 1.0 / (sigma_rad * std::sqrt(slope2));
  result.residual = scale * residual;
  result.jacobian.head<3>() = scale * turned.cross(normal_of_landmark);
  result.jacobian.tail<2>() = scale * basis.transpose() * turned.cross(pair.landmark);
  return result;
}

}  // namespace

EpipolarMotion refine_epipolar_motion(const EpipolarMotion& start, std::span<const BearingPair> pairs,
                                      double bearing_sigma_rad) {
  const vision::CauchyLoss loss(kEpipolarLossScale);
  EpipolarMotion motion = start;
  Matrix5d information;
  for (int step = 0; step < kSteps; ++step) {
    const Basis basis = across_baseline(motion.direction);
    // prior of one radian on the direction, for data that do not determine it
    information = Vector5d(0.0, 0.0, 0.0, 1.0, 1.0).asDiagonal();
    Vector5d gradient = Vector5d::Zero();
    for (const auto& pair : pairs) {
      const auto term = whitened_distance(pair, motion, basis, bearing_sigma_rad);
      const double weight = loss.weight(term.residual * term.residual);
      information += weight * term.jacobian * term.jacobian.transpose();
      gradient += weight * term.residual * term.jacobian;
    }
    const Vector5d change = -information.ldlt().solve(gradient);
    if (!change.allFinite()) return start;
    motion.rotation = vision::so3_exp(change.head<3>()) * motion.rotation;
    motion.direction = (motion.direction + basis * change.tail<2>()).normalized();
  }
  motion.covariance = information.inverse().topLeftCorner<3, 3>();
  return motion;
}

}  // namespace panvo::position_corrector

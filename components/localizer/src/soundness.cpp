// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/soundness.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace panvo::localizer {
namespace {

constexpr double kMaxCoordinate_m = 1e7;
constexpr double kMaxVariance = 1e12;
constexpr double kRotationTolerance = 1e-3;
constexpr double kMessageRounding = 1e-6;  // relative to the largest entry: accumulated rounding of covariances
constexpr double kMaxAngle_rad = 6.0 * std::numbers::pi;
constexpr double kMinAngleVariance = 1e-12;
constexpr double kMaxAngleVariance = 1e4;

}  // namespace

std::optional<std::string> fault_of(const Eigen::Isometry3d& pose, const vision::Matrix6d& covariance) {
  if (!pose.matrix().allFinite() || !covariance.allFinite()) return "has values that are not finite";
  const Eigen::Matrix3d product = pose.linear() * pose.linear().transpose();
  if (!product.isApprox(Eigen::Matrix3d::Identity(), kRotationTolerance)) return "has an invalid rotation";
  if (pose.translation().cwiseAbs().maxCoeff() > kMaxCoordinate_m) return "has a position beyond 10,000 km";
  const double most = covariance.cwiseAbs().maxCoeff();
  if (most > kMaxVariance) return "has a variance above 1e12";
  const vision::Matrix6d skew = covariance - covariance.transpose();
  if (skew.cwiseAbs().maxCoeff() > kMessageRounding * most) return "has a covariance that is not symmetric";
  const Eigen::SelfAdjointEigenSolver<vision::Matrix6d> parts(covariance, Eigen::EigenvaluesOnly);
  if (parts.eigenvalues()[0] < -kMessageRounding * most) return "has a covariance that is not positive semidefinite";
  return std::nullopt;
}

std::optional<std::string> fault_of_angle(double angle_rad, double variance_rad2) {
  if (!std::isfinite(angle_rad) || !std::isfinite(variance_rad2)) return "has values that are not finite";
  if (std::abs(angle_rad) > kMaxAngle_rad) return "has an angle of more than three turns";
  if (variance_rad2 < kMinAngleVariance || variance_rad2 > kMaxAngleVariance) {
    return "has an implausible variance";
  }
  return std::nullopt;
}

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/integrity.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace panvo::localizer {
namespace {

constexpr int kRays = 32;      // over a quarter of the ellipse
constexpr int kHalvings = 30;  // of the interval in which the radius is searched

}  // namespace

double protection_radius(const Eigen::Matrix2d& covariance, double risk, double tail) {
  const Eigen::Vector2d variance =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance, Eigen::EigenvaluesOnly).eigenvalues().cwiseMax(0.0);
  const double of_circle_m = std::sqrt(variance[1] * tail * (std::pow(risk, -2.0 / tail) - 1.0));
  if (!(of_circle_m > 0.0) || !std::isfinite(of_circle_m)) return of_circle_m;
  // An error is a point of the unit circle's distribution, stretched by the axes: on each ray by another length.
  std::array<double, kRays> stretch;
  for (int i = 0; i < kRays; ++i) {
    const double angle = (i + 0.5) / kRays * 0.5 * std::numbers::pi;
    stretch[i] = variance[1] * std::pow(std::cos(angle), 2) + variance[0] * std::pow(std::sin(angle), 2);
  }
  const auto is_exceeded_too_often = [&](double radius_m) {
    double sum = 0.0;
    for (const double square : stretch) sum += std::pow(1.0 + radius_m * radius_m / (tail * square), -0.5 * tail);
    return sum > risk * kRays;
  };
  double least_m = 0.0, most_m = of_circle_m;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (least_m + most_m);
    (is_exceeded_too_often(middle_m) ? least_m : most_m) = middle_m;
  }
  return most_m;
}

Integrity assess(const LocalizedPose& pose, const std::vector<Doubt>& doubts, const IntegrityParameters& parameters) {
  Integrity integrity;
  integrity.protection_level_m =
      protection_radius(pose.covariance.topLeftCorner<2, 2>(), parameters.risk, parameters.tail);
  for (const auto& doubt : doubts) {
    integrity.protection_level_m += doubt.off_m;
    if (doubt.forbids_use && integrity.reason.empty()) integrity.reason = doubt.reason;
  }
  const bool is_known = pose.state == State::kTracking || pose.state == State::kRelocalised;
  if (!is_known) {
    integrity.reason = pose.reason.empty() ? to_text(pose.state) : to_text(pose.state) + ": " + pose.reason;
  } else if (integrity.reason.empty() && !(integrity.protection_level_m <= parameters.alert_limit_m)) {
    integrity.reason = fmt::format("protection level {:.2f} m exceeds the alert limit of {:.2f} m",
                                   integrity.protection_level_m, parameters.alert_limit_m);
  }
  integrity.is_usable = integrity.reason.empty();
  return integrity;
}

}  // namespace panvo::localizer

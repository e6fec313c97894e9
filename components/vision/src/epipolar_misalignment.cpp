// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/epipolar_misalignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "panvo/vision/robust_loss.hpp"

namespace panvo::vision {
namespace {

using Parts = EpipolarMisalignment::Parts;

// Standard deviations for an aged calibration. The rotation about Y is narrower because unmodelled lens distortion
// resembles it.
Parts expected() { return (Parts() << 1.0, 3e-3, 1e-3, 3e-3, 2e-3, 5e-3).finished(); }

constexpr double kMemory = 20000.0;  // points; several minutes of driving
// Chi-square with 6 degrees of freedom; an aged calibration exceeds it with probability 1/3000.
constexpr double kPlausible = 25.0;
constexpr double kLossScale = 2.0;  // of the Cauchy loss, in standard deviations

Eigen::Vector2d normalised(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return camera.unproject(pixel).head<2>();
}

}  // namespace

Parts EpipolarMisalignment::row_by_parts(const PinholeCamera& camera, const Eigen::Vector2d& ideal_right_pixel) {
  const Eigen::Vector2d at = normalised(camera, ideal_right_pixel);
  const double x = at.x(), y = at.y(), f = camera.fy;
  return {1.0, f * (1.0 + y * y), -f * x * y, -f * x, f * y, f * at.squaredNorm() * y};
}

Eigen::Vector2d EpipolarMisalignment::shift(const PinholeCamera& camera,
                                            const Eigen::Vector2d& ideal_right_pixel) const {
  const Eigen::Vector2d at = normalised(camera, ideal_right_pixel);
  const double x = at.x(), y = at.y();
  const double row_shift_px = row_by_parts(camera, ideal_right_pixel).dot(parts);
  if (!holds_for_columns()) return {0.0, row_shift_px};
  // A rotation about Y mostly shifts all columns alike, which row errors do not observe; it is left to the estimation
  // from motion.
  const Parts column_by_parts = (Parts() << 0.0, x * y, 0.0, y, x, at.squaredNorm() * x).finished() * camera.fx;
  return {column_by_parts.dot(parts), row_shift_px};
}

bool EpipolarMisalignment::holds_for_columns() const {
  return parts.cwiseQuotient(expected()).squaredNorm() < kPlausible;
}

double EpipolarMisalignment::max_row_shift_px(const PinholeCamera& camera) const {
  const double right = camera.width - 1.0, bottom = camera.height - 1.0;
  double max_px = 0.0;
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(right, 0.0), Eigen::Vector2d(0.0, bottom),
        Eigen::Vector2d(right, bottom), Eigen::Vector2d(0.5 * right, 0.5 * bottom)}) {
    max_px = std::max(max_px, std::abs(shift(camera, at).y()));
  }
  return max_px;
}

EpipolarCalibration::EpipolarCalibration(const PinholeCamera& camera)
    : camera_(camera), prior_(expected().cwiseAbs2().cwiseInverse().asDiagonal()), information_(prior_) {}

void EpipolarCalibration::add(const Eigen::Vector2d& ideal_right_pixel, double row_error_px, double sigma_px) {
  const Parts by_parts = EpipolarMisalignment::row_by_parts(camera_, ideal_right_pixel);
  // Includes the uncertainty of the misalignment, so that the first points are not down-weighted.
  const double expected_variance = sigma_px * sigma_px + by_parts.dot(information_.ldlt().solve(by_parts));
  const double residual = row_error_px - by_parts.dot(misalignment_.parts);
  const double weight = CauchyLoss(kLossScale).weight(residual * residual / expected_variance) / (sigma_px * sigma_px);
  const double fading = 1.0 - 1.0 / kMemory;
  information_ = fading * information_ + (1.0 - fading) * prior_ + weight * by_parts * by_parts.transpose();
  weighted_sum_ = fading * weighted_sum_ + weight * row_error_px * by_parts;
}

void EpipolarCalibration::settle() { misalignment_.parts = information_.ldlt().solve(weighted_sum_); }

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "lean_sigma.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::binocular_odometry {
namespace {

constexpr double kMean_m = 50.0;  // rain and dirt last, vehicles pass: a lean counts where it lasts for tens of metres

}  // namespace

LeanSigma::LeanSigma(const vision::RectifiedStereo& stereo, const MotionParameters& parameters)
    : of_calibration_rad_per_m_(parameters.rectification_error_px / (stereo.camera.fx * stereo.baseline_m)),
      per_outlier_share_rad_per_m_(parameters.outlier_lean_rad_per_m) {}

void LeanSigma::add(double inlier_ratio, double way_m) {
  if (!(way_m > 0.0)) return;
  way_m_ = std::min(way_m_ + way_m, kMean_m);
  outlier_share_ += std::min(way_m / way_m_, 1.0) * (1.0 - inlier_ratio - outlier_share_);
}

double LeanSigma::rad_per_m() const {
  return std::hypot(of_calibration_rad_per_m_, per_outlier_share_rad_per_m_ * outlier_share_);
}

}  // namespace panvo::binocular_odometry

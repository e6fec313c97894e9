// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {

/// Standard deviation of what odometry turns per metre without noticing: by the calibration, more with a small baseline
/// or focal length, and by the scene. Where many points contradict the motion, as in rain, through a dirty lens or beside
/// vehicles, some that agree with it are wrong, too.
class LeanSigma {
 public:
  LeanSigma(const vision::RectifiedStereo& stereo, const MotionParameters& parameters);

  /// Adds a step: points that agree with its motion, per candidate.
  void add(double inlier_ratio, double way_m);

  double rad_per_m() const;
  /// Of the calibration alone.
  double of_calibration_rad_per_m() const noexcept { return of_calibration_rad_per_m_; }

 private:
  double of_calibration_rad_per_m_, per_outlier_share_rad_per_m_;
  double way_m_ = 0.0;
  double outlier_share_ = 0.0;  // mean of the last way
};

}  // namespace panvo::binocular_odometry

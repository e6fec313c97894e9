// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "panvo/vision/camera.hpp"

namespace panvo::vision {

/// Row misalignment between the images of a rectified pair, from residual calibration errors, temperature and shocks.
/// Linear in small parameters. A constant shift along the rows is not included because row errors do not observe it.
struct EpipolarMisalignment {
  using Parts = Eigen::Matrix<double, 6, 1>;
  /// Right camera relative to the left: principal point along v (px); rotation about X, Y, Z (rad); focal length ratio
  /// minus 1; difference of k1.
  Parts parts = Parts::Zero();
  /// Whether the parts are plausible as a small rotation and lens change, so that they also predict column shifts.
  /// Otherwise (e.g. an unsuitable lens model) only the row shifts are used.
  bool holds_for_columns() const;

  /// Derivative of the v coordinate (px) with respect to each part, at the undisturbed pixel.
  static Parts row_by_parts(const PinholeCamera& camera, const Eigen::Vector2d& ideal_right_pixel);

  /// Displacement from the pixel in an aligned right image to the pixel in the actual right image (px).
  Eigen::Vector2d shift(const PinholeCamera& camera, const Eigen::Vector2d& ideal_right_pixel) const;

  /// Largest absolute row shift over the corners and the centre of the image (px).
  double max_row_shift_px(const PinholeCamera& camera) const;
};

/// Estimates the misalignment online from row errors: linear least squares with exponential forgetting per point, to
/// follow thermal drift [cf. Dang, Hoffmann, Stiller 2009, "Continuous stereo self-calibration by camera parameter
/// tracking"].
class EpipolarCalibration {
 public:
  explicit EpipolarCalibration(const PinholeCamera& camera);

  /// Adds a point whose row in the right image is `row_error_px` (standard deviation `sigma_px`) below its row in the
  /// left image.
  void add(const Eigen::Vector2d& ideal_right_pixel, double row_error_px, double sigma_px);

  /// Updates misalignment() with the points added since the last call.
  void settle();

  const EpipolarMisalignment& misalignment() const noexcept { return misalignment_; }

 private:
  using Information = Eigen::Matrix<double, 6, 6>;

  PinholeCamera camera_;
  Information prior_, information_;
  EpipolarMisalignment::Parts weighted_sum_ = EpipolarMisalignment::Parts::Zero();
  EpipolarMisalignment misalignment_;
};

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "panvo/vision/camera.hpp"

namespace panvo::vision {

/// By how little the right image of a rectified pair is off the left one's rows: what a calibration leaves over, and what heat and shocks
/// add. Small, so that the parts add up. A constant shift along the rows is not among them: no row tells of it.
struct EpipolarMisalignment {
  using Parts = Eigen::Matrix<double, 6, 1>;
  /// Principal point along v (px); right camera's turn about its X, Y, Z (rad); its focal length over the left's, less one; its k1 less the
  /// left's.
  Parts parts = Parts::Zero();
  /// Whether the parts are those of a camera that has turned and a lens that has changed a little, so that they hold for columns too. Rows
  /// that are off in another way, of a lens that its model does not fit, tell of rows alone.
  bool holds_for_columns() const;

  /// How each part moves the pixel of a point along v (px), at the pixel where it would be without.
  static Parts row_by_parts(const PinholeCamera& camera, const Eigen::Vector2d& ideal_right_pixel);

  /// From the pixel of a point in an aligned right image to where the right image has it (px).
  Eigen::Vector2d shift(const PinholeCamera& camera, const Eigen::Vector2d& ideal_right_pixel) const;

  /// How far the rows are off where they are farthest off, in a corner or in the middle of the image (px).
  double largest_row_shift_px(const PinholeCamera& camera) const;
};

/// Finds the misalignment while driving, from how far off their rows points are found: linear least squares that fade with the number of
/// points, so that what heat changes is followed [cf. Dang, Hoffmann, Stiller 2009, "Continuous stereo self-calibration by camera
/// parameter tracking"].
class EpipolarCalibration {
 public:
  explicit EpipolarCalibration(const PinholeCamera& camera);

  /// A point whose row in the right image is `row_error_px` below that in the left one, give or take `sigma_px`.
  void add(const Eigen::Vector2d& ideal_right_pixel, double row_error_px, double sigma_px);

  /// Takes up what was added since.
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

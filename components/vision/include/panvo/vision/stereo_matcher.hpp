// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/vision/epipolar_misalignment.hpp"
#include "panvo/vision/image_pyramid.hpp"

namespace panvo::vision {

/// Match of a left pixel's neighbourhood in the right image.
struct StereoMatch {
  double disparity_px = 0.0;                           ///< u_left - u_right
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< of the disparity along u and v: surface slant
  double correlation = 0.0;                            ///< zero-mean normalised, at full resolution
  double variance_px2 = 0.0;                           ///< of the disparity, from the residuals
};

/// Row error of a point: its row in the right image minus its row in the left image.
struct RowError {
  Eigen::Vector2d ideal_right_pixel = Eigen::Vector2d::Zero();  ///< pixel in an aligned right image
  double error_px = 0.0;
  double sigma_px = 0.0;
};

/// Matches along the rows of a rectified pair, to sub-pixel accuracy, including slanted surfaces: on a road the
/// disparity grows by baseline / camera height per row, which a window of constant disparity does not fit.
class StereoMatcher {
 public:
  struct Range {
    double from_px = 0.0;
    double to_px = 0.0;
  };

  StereoMatcher(const PinholeCamera& camera, Range range, double min_correlation)
      : camera_(camera), range_(range), min_correlation_(min_correlation) {}

  /// Compensates this misalignment of the right image from now on. Disparities refer to an aligned right image.
  void allow_for(const EpipolarMisalignment& misalignment) { misalignment_ = misalignment; }

  /// Searches the whole disparity range. Returns nullopt if there is no match or the match is ambiguous.
  std::optional<StereoMatch> search(const ImagePyramid& left, const ImagePyramid& right,
                                    const Eigen::Vector2d& pixel) const;

  /// Estimates disparity and gradient, starting from an expected match.
  std::optional<StereoMatch> measure(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                     double expected_disparity_px, const Eigen::Vector2d& expected_gradient) const;

  /// Estimates the disparity near an expected one; the gradient is kept.
  std::optional<StereoMatch> refine(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                    double expected_disparity_px, const Eigen::Vector2d& gradient) const;

  /// Measures the row error of a matched point; nullopt if its neighbourhood has too little vertical gradient.
  std::optional<RowError> row_error(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                    const StereoMatch& match) const;

 private:
  bool accepts(const StereoMatch& match) const;
  /// Offset to add to (u_left - disparity, v) to get the pixel in the right image.
  Eigen::Vector2d shift(const Eigen::Vector2d& left_pixel, double disparity_px) const {
    return misalignment_.shift(camera_, {left_pixel.x() - disparity_px, left_pixel.y()});
  }

  PinholeCamera camera_;
  EpipolarMisalignment misalignment_;
  Range range_;
  double min_correlation_;
};

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/vision/epipolar_misalignment.hpp"
#include "panvo/vision/image_pyramid.hpp"

namespace panvo::vision {

/// Where a left pixel's neighbourhood lies in the right image.
struct StereoMatch {
  double disparity_px = 0.0;                           ///< u_left - u_right
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< of the disparity along u and v: the slant of the surface
  double correlation = 0.0;                            ///< zero-mean normalised, at full resolution
  double variance_px2 = 0.0;                           ///< of the disparity, by the image noise left over
};

/// How far below its row in the left image the right image has a point.
struct RowError {
  Eigen::Vector2d ideal_right_pixel = Eigen::Vector2d::Zero();  ///< where an aligned right image would have it
  double error_px = 0.0;
  double sigma_px = 0.0;
};

/// Matches along the rows of a rectified pair, to sub-pixel accuracy and on slanted surfaces: under a road the disparity
/// grows by the ratio of baseline to camera height from row to row, which a window of equal disparity does not fit.
class StereoMatcher {
 public:
  struct Range {
    double from_px = 0.0;
    double to_px = 0.0;
  };

  StereoMatcher(const PinholeCamera& camera, Range range, double smallest_correlation)
      : camera_(camera), range_(range), smallest_correlation_(smallest_correlation) {}

  /// Looks from now on where the right image, this much off, has things. Disparities are those of an aligned one.
  void allow_for(const EpipolarMisalignment& misalignment) { misalignment_ = misalignment; }

  /// Over the whole range. nullopt where nothing resembles the pixel's neighbourhood, or two places do.
  std::optional<StereoMatch> search(const ImagePyramid& left, const ImagePyramid& right,
                                    const Eigen::Vector2d& pixel) const;

  /// Near an expected match, disparity and gradient both measured anew.
  std::optional<StereoMatch> measure(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                     double expected_disparity_px, const Eigen::Vector2d& expected_gradient) const;

  /// Near an expected disparity with an expected gradient (kept as it is).
  std::optional<StereoMatch> refine(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                    double expected_disparity_px, const Eigen::Vector2d& gradient) const;

  /// How far off its row a matched point is; nullopt where its neighbourhood has no edge along the row that would tell.
  std::optional<RowError> row_error(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                    const StereoMatch& match) const;

 private:
  bool accepts(const StereoMatch& match) const;
  /// What to add to a left pixel so that, less its disparity, it is the right image's.
  Eigen::Vector2d shift(const Eigen::Vector2d& left_pixel, double disparity_px) const {
    return misalignment_.shift(camera_, {left_pixel.x() - disparity_px, left_pixel.y()});
  }

  PinholeCamera camera_;
  EpipolarMisalignment misalignment_;
  Range range_;
  double smallest_correlation_;
};

}  // namespace panvo::vision

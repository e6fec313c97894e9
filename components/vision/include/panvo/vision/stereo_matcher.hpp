// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/vision/image_pyramid.hpp"

namespace panvo::vision {

/// Where a left pixel's neighbourhood lies in the right image.
struct StereoMatch {
  double disparity_px = 0.0;                           ///< u_left - u_right
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< of the disparity along u and v: the slant of the surface
  double correlation = 0.0;                            ///< zero-mean normalised, at full resolution
  double variance_px2 = 0.0;                           ///< of the disparity, by the image noise left over
};

/// Matches along the rows of a rectified pair, to sub-pixel accuracy and on slanted surfaces: under a road the disparity
/// grows by the ratio of baseline to camera height from row to row, which a window of equal disparity does not fit.
class StereoMatcher {
 public:
  struct Range {
    double from_px = 0.0;
    double to_px = 0.0;
  };

  StereoMatcher(Range range, double smallest_correlation)
      : range_(range), smallest_correlation_(smallest_correlation) {}

  /// Over the whole range. nullopt where nothing resembles the pixel's neighbourhood, or two places do.
  std::optional<StereoMatch> search(const ImagePyramid& left, const ImagePyramid& right,
                                    const Eigen::Vector2d& pixel) const;

  /// Near an expected match, disparity and gradient both measured anew.
  std::optional<StereoMatch> measure(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                     double expected_disparity_px, const Eigen::Vector2d& expected_gradient) const;

  /// Near an expected disparity with an expected gradient (kept as it is).
  std::optional<StereoMatch> refine(const ImagePyramid& left, const ImagePyramid& right, const Eigen::Vector2d& pixel,
                                    double expected_disparity_px, const Eigen::Vector2d& gradient) const;

 private:
  bool accepts(const StereoMatch& match) const;

  Range range_;
  double smallest_correlation_;
};

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::simulation {

/// A tileable picture of a surface with its mip pyramid; colours are linear (not gamma-encoded) reflectances.
class Texture {
 public:
  /// `albedo` is CV_8UC4, RGBA: sRGB-encoded colour and linear alpha; width and height are powers of two.
  explicit Texture(const cv::Mat& albedo);

  int width() const;
  int height() const;
  const Eigen::Vector4f& mean() const;  ///< linear RGB and alpha

  /// Linear RGB and alpha (0..1) at `uv` (in periods: the picture spans [0, 1)), averaged over the parallelogram of
  /// `du` and `dv`, the steps of uv from one pixel to the next along the image's columns and rows: trilinear, with up
  /// to `taps` probes along the longer one.
  Eigen::Vector4f sample(const Eigen::Vector2f& uv, const Eigen::Vector2f& du, const Eigen::Vector2f& dv,
                         int taps) const;

  /// Alpha only, bilinear, in the pyramid's level 0: for what only asks whether there is a hole.
  float alpha(const Eigen::Vector2f& uv) const;

 private:
  struct Level;
  std::vector<cv::Mat> levels_;  // CV_8UC4, linearised through a table when sampled
  Eigen::Vector4f mean_;
};

}  // namespace panvo::simulation

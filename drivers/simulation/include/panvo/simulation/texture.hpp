// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::simulation {

/// A tileable picture of a surface with its mip pyramid; colours are linear (not gamma-encoded) reflectances.
class Texture {
 public:
  /// `albedo` is CV_8UC4, RGBA: sRGB-encoded colour and linear alpha; width and height are powers of two, else throws
  /// std::invalid_argument. Its row 0 is at v = 0. Coarser levels keep the share of texels with alpha >= 0.5.
  explicit Texture(const cv::Mat& albedo);

  int width() const { return levels_.front().column_mask + 1; }
  int height() const { return levels_.front().row_mask + 1; }
  const Eigen::Vector4f& mean() const { return mean_; }  ///< linear RGB (weighted by alpha) and alpha

  /// Linear RGB and alpha (0..1) at `uv` (in periods: the picture spans [0, 1)), averaged over the parallelogram of
  /// `du` and `dv`, the steps of uv from one pixel to the next along the image's columns and rows: trilinear, with up
  /// to `taps` probes along the longer one.
  Eigen::Vector4f sample(const Eigen::Vector2f& uv, const Eigen::Vector2f& du, const Eigen::Vector2f& dv,
                         int taps) const;

  /// RGBA of all levels of the pyramid, each half as wide and high (at least 1) as the one before, row by row; bytes
  /// are square roots of linear values.
  const std::vector<std::uint8_t>& texels() const { return texels_; }

  /// Alpha only, bilinear, in the pyramid's level 0: for what only asks whether there is a hole.
  float alpha(const Eigen::Vector2f& uv) const;

 private:
  struct Level {
    std::uint32_t offset = 0;  ///< of its first byte in texels_
    int column_mask = 0;       ///< width - 1
    int row_mask = 0;          ///< height - 1
  };

  std::vector<Level> levels_;
  std::vector<std::uint8_t> texels_;  ///< RGBA of all levels one after the other, square roots of linear values
  cv::Mat1b alpha_;                   ///< of level 0; empty where there is no hole
  Eigen::Vector4f mean_;
};

}  // namespace panvo::simulation

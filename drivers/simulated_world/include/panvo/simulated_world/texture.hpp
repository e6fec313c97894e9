// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace panvo::simulated_world {

/// A tileable picture of a surface with its mip pyramid; colours are linear (not gamma-encoded) reflectances.
class Texture {
 public:
  /// `albedo`: CV_8UC4, RGBA, sRGB-encoded colour and linear alpha, row 0 at v = 0; throws std::invalid_argument unless
  /// width and height are powers of two. Coarser levels keep the fraction of texels with alpha >= 0.5.
  explicit Texture(const cv::Mat& albedo);

  int width() const { return levels_.front().column_mask + 1; }
  int height() const { return levels_.front().row_mask + 1; }
  const Eigen::Vector4f& mean() const { return mean_; }  ///< linear RGB (weighted by alpha) and alpha

  /// Linear RGB and alpha (0..1) at `uv` (in periods: the picture spans [0, 1)), averaged over the parallelogram of
  /// `du` and `dv`, the steps of uv from one pixel to the next along the image's columns and rows: trilinear, with up
  /// to `taps` probes along the longer one.
  Eigen::Vector4f sample(const Eigen::Vector2f& uv, const Eigen::Vector2f& du, const Eigen::Vector2f& dv,
                         int taps) const;

  /// RGBA of all pyramid levels, each half as wide and high (at least 1) as the previous one, row by row; bytes are
  /// square roots of linear values.
  const std::vector<std::uint8_t>& texels() const { return texels_; }

  /// Alpha only, bilinear, from pyramid level 0: to test for holes.
  float alpha(const Eigen::Vector2f& uv) const;

 private:
  struct Level {
    std::uint32_t offset = 0;  ///< of its first byte in texels_
    int column_mask = 0;       ///< width - 1
    int row_mask = 0;          ///< height - 1
  };

  std::vector<Level> levels_;
  std::vector<std::uint8_t> texels_;  ///< RGBA of all levels in sequence, square roots of linear values
  cv::Mat1b alpha_;                   ///< of level 0; empty if there are no holes
  Eigen::Vector4f mean_;
};

}  // namespace panvo::simulated_world

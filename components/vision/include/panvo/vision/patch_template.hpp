// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

namespace panvo::vision {

/// Position of a template in an image.
struct PatchAlignment {
  Eigen::Vector2d position;  ///< template centre, px
  double correlation = 0.0;  ///< zero-mean normalised cross-correlation, -1 to 1
  Eigen::Vector2d variance;  ///< of the position along u and v, from the residuals, px^2
};

/// A square image patch, warped to its expected appearance in another view and aligned there to sub-pixel accuracy by
/// inverse compositional Lucas-Kanade (Gauss-Newton on the gradients of the template). Gain and offset of the
/// brightness are estimated together with the position.
class PatchTemplate {
 public:
  static constexpr int kSize = 12;  ///< side length in the target image, px

  enum class Search { kPlane, kRow };  ///< along u and v, or along u only (rectified stereo)

  /// Samples the neighbourhood of `centre` (px) in a CV_8UC1 image. `source_from_target`, the linear part of the
  /// expected warp, maps offsets in the target image to offsets in this one. Returns nullopt if the patch leaves the
  /// image or has too little texture.
  static std::optional<PatchTemplate> sample(const cv::Mat& image, const Eigen::Vector2d& centre,
                                             const Eigen::Matrix2d& source_from_target = Eigen::Matrix2d::Identity());

  /// Aligns the template in a CV_8UC1 image, starting at `start` (px). Returns nullopt if it leaves the image, moves by
  /// more than `reach_px`, has inverted or very low contrast, or does not converge.
  std::optional<PatchAlignment> align(const cv::Mat& image, const Eigen::Vector2d& start, Search search,
                                      double reach_px) const;

 private:
  static constexpr int kPixels = kSize * kSize;

  struct Projections {
    double intensity;          // sum of I
    double square;             // sum of I^2
    Eigen::Vector3d on_basis;  // sum of I times each basis image
  };

  PatchTemplate() = default;
  bool prepare(const std::array<float, (kSize + 2) * (kSize + 2)>& samples);
  Projections project(const cv::Mat& image, double left, double top) const;

  // Basis images: intensity, d/du, d/dv. Means are removed, which eliminates the brightness offset.
  std::array<std::array<float, kPixels>, 3> basis_{};
  Eigen::Matrix3d inverse_plane_;  // inverse normal matrix of all three
  Eigen::Matrix2d inverse_row_;    // inverse normal matrix of the first two
  double energy_ = 0.0;            // sum of squares of the intensity basis
};

}  // namespace panvo::vision

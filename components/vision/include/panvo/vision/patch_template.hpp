// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

namespace panvo::vision {

/// Where a template was found in an image.
struct PatchAlignment {
  Eigen::Vector2d position;  ///< px, of the template's centre
  double correlation = 0.0;  ///< zero-mean normalised cross-correlation, -1 to 1
  Eigen::Vector2d variance;  ///< px^2, of the position along u and v, by the image noise left over
};

/// A small square of an image, warped to how another view is expected to show it, and found there to sub-pixel accuracy
/// by Gauss-Newton steps on the template's own gradients (inverse compositional Lucas-Kanade). Brightness may differ by
/// any gain and offset: both are solved for along with the position.
class PatchTemplate {
 public:
  static constexpr int kSize = 12;  ///< px on a side, of the target image

  enum class Search { kPlane, kRow };  ///< free in u and v, or in u alone (rectified stereo)

  /// Samples the neighbourhood of `centre` (px) in a CV_8UC1 image. `source_from_target` takes offsets in the target image
  /// to offsets in this one, the linear part of the expected warp. nullopt where the patch leaves the image or has too
  /// little texture to be found again.
  static std::optional<PatchTemplate> sample(const cv::Mat& image, const Eigen::Vector2d& centre,
                                             const Eigen::Matrix2d& source_from_target = Eigen::Matrix2d::Identity());

  /// Finds the template in a CV_8UC1 image, starting at `start` (px). nullopt where it leaves the image, wanders off by more
  /// than `reach_px`, meets inverted contrast or does not settle within the iterations.
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

  // Basis images, means removed (which takes the brightness offset out of the problem): intensity, d/du, d/dv.
  std::array<std::array<float, kPixels>, 3> basis_{};
  Eigen::Matrix3d inverse_plane_;  // of the normal matrix of all three
  Eigen::Matrix2d inverse_row_;    // of the first two
  double energy_ = 0.0;            // sum of squares of the intensity basis
};

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/stereo_matcher.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "panvo/vision/patch_template.hpp"
#include "row_search.hpp"

namespace panvo::vision {
namespace {

constexpr int kSize = PatchTemplate::kSize;
constexpr double kHalf = 0.5 * (kSize - 1);
constexpr int kIterations = 5;
constexpr double kSettled_px = 0.01;
constexpr double kLargestStep_px = 2.0;
constexpr double kGradientSigma = 0.3;       // prior: facing walls have 0, a road baseline over camera height, 0.1 to 0.35
constexpr double kNoise = 4.0;               // grey levels: weight of that prior against the image
constexpr double kCoarseCorrelation = 0.6;   // of a window that ignores the slant
constexpr double kReach_px = 3.0;

float grey(const cv::Mat& image, double u, double v) {
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const auto fu = static_cast<float>(u - column), fv = static_cast<float>(v - row);
  const uchar* upper = image.ptr<uchar>(row) + column;
  const uchar* lower = upper + image.step[0];
  const float above = static_cast<float>(upper[0]) + fu * static_cast<float>(upper[1] - upper[0]);
  const float below = static_cast<float>(lower[0]) + fu * static_cast<float>(lower[1] - lower[0]);
  return above + fv * (below - above);
}

bool inside(const cv::Mat& image, double u, double v) {
  return u >= 0.0 && v >= 0.0 && u < image.cols - 1 && v < image.rows - 1;
}

// Gauss-Newton over gain, offset, disparity and its two gradients, on the left patch's gradients along the row.
class SlantedPatch {
 public:
  static std::optional<SlantedPatch> sample(const cv::Mat& left, const Eigen::Vector2d& centre) {
    if (!inside(left, centre.x() - kHalf - 1, centre.y() - kHalf) || !inside(left, centre.x() + kHalf + 1, centre.y() + kHalf)) {
      return std::nullopt;
    }
    SlantedPatch patch(centre);
    Basis mean = Basis::Zero();
    for (int pixel = 0; pixel < kSize * kSize; ++pixel) {
      const Eigen::Vector2d offset = offset_of(pixel);
      const Eigen::Vector2d at = centre + offset;
      const double slope = 0.5 * (grey(left, at.x() + 1, at.y()) - grey(left, at.x() - 1, at.y()));
      patch.basis_[static_cast<size_t>(pixel)] =
          Basis(grey(left, at.x(), at.y()), slope, slope * offset.x(), slope * offset.y());
      mean += patch.basis_[static_cast<size_t>(pixel)] / (kSize * kSize);
    }
    patch.normal_.setZero();
    for (Basis& b : patch.basis_) {
      b -= mean;
      patch.normal_ += b * b.transpose();
    }
    return patch;
  }

  // Improves `match` (in this level's px) in place; false when it leaves the image or does not resemble.
  bool align(const cv::Mat& right, StereoMatch& match) const {
    constexpr double kPriorWeight = kNoise * kNoise / (kGradientSigma * kGradientSigma);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      double sum = 0.0, square = 0.0;
      Basis projection = Basis::Zero();
      for (int pixel = 0; pixel < kSize * kSize; ++pixel) {
        const Eigen::Vector2d offset = offset_of(pixel);
        const double u = centre_.x() + offset.x() - match.disparity_px - match.gradient.dot(offset);
        const double v = centre_.y() + offset.y();
        if (!inside(right, u, v)) return false;
        const double value = grey(right, u, v);
        sum += value;
        square += value * value;
        projection += value * basis_[static_cast<size_t>(pixel)];
      }
      const double variation = square - sum * sum / (kSize * kSize);
      match.correlation = projection.x() / std::sqrt(std::max(variation * normal_(0, 0), 1e-12));

      Eigen::Matrix4d normal = normal_;
      Basis target = projection;
      normal(1, 1) += 1e-6 * normal_(0, 0);
      normal.diagonal().tail<2>().array() += kPriorWeight;
      target.tail<2>() -= kPriorWeight * match.gradient;
      const Eigen::Matrix4d inverse = normal.inverse();
      const Basis solution = inverse * target;
      const double gain = solution.x();
      if (!(gain > 0.25) || !solution.allFinite()) return false;
      const double step = solution.y() / gain;
      if (std::abs(step) > kLargestStep_px) return false;
      match.disparity_px += step;
      match.gradient += solution.tail<2>() / gain;
      const double residual = std::max(0.0, variation - solution.dot(projection));
      match.variance_px2 = residual / ((kSize * kSize - 5) * gain * gain) * inverse(1, 1);
      if (std::abs(step) < kSettled_px) break;
    }
    return true;
  }

 private:
  using Basis = Eigen::Vector4d;  // intensity, du, du * x, du * y; means removed

  explicit SlantedPatch(const Eigen::Vector2d& centre) : centre_(centre) {}
  static Eigen::Vector2d offset_of(int pixel) { return {pixel % kSize - kHalf, pixel / kSize - kHalf}; }

  Eigen::Vector2d centre_;
  std::array<Basis, kSize * kSize> basis_;
  Eigen::Matrix4d normal_;
};

}  // namespace

std::optional<StereoMatch> StereoMatcher::search(const ImagePyramid& left, const ImagePyramid& right,
                                                 const Eigen::Vector2d& pixel) const {
  const int coarse = std::min(1, left.levels() - 1);
  const double scale = 1 << coarse;
  const cv::Point place(static_cast<int>(std::lround(pixel.x() / scale)), static_cast<int>(std::lround(pixel.y() / scale)));
  const auto found = search_row(left[coarse], right[coarse], place, static_cast<int>(std::floor(range_.from_px / scale)),
                                static_cast<int>(std::ceil(range_.to_px / scale)), kCoarseCorrelation);
  if (!found) return std::nullopt;

  StereoMatch match;
  match.disparity_px = *found;
  for (int level = coarse; level >= 0; --level) {
    const auto patch = SlantedPatch::sample(left[level], pixel / (1 << level));
    // A coarse patch that does not fit (too near the border, say) leaves the finer one to try.
    StereoMatch improved = match;
    if (patch && patch->align(right[level], improved)) {
      match = improved;
    } else if (level == 0) {
      return std::nullopt;
    }
    if (level > 0) match.disparity_px *= 2.0;
  }
  if (!accepts(match)) return std::nullopt;
  return match;
}

std::optional<StereoMatch> StereoMatcher::measure(const ImagePyramid& left, const ImagePyramid& right,
                                                  const Eigen::Vector2d& pixel, double expected_disparity_px,
                                                  const Eigen::Vector2d& expected_gradient) const {
  StereoMatch match{expected_disparity_px, expected_gradient};
  const auto patch = SlantedPatch::sample(left[0], pixel);
  if (!patch || !patch->align(right[0], match) || !accepts(match)) return std::nullopt;
  return match;
}

std::optional<StereoMatch> StereoMatcher::refine(const ImagePyramid& left, const ImagePyramid& right,
                                                 const Eigen::Vector2d& pixel, double expected_disparity_px,
                                                 const Eigen::Vector2d& gradient) const {
  Eigen::Matrix2d right_from_left;
  right_from_left << 1.0 - gradient.x(), -gradient.y(), 0.0, 1.0;
  if (right_from_left(0, 0) < 0.25) return std::nullopt;  // seen almost edge-on
  const auto patch = PatchTemplate::sample(left[0], pixel, right_from_left.inverse());
  if (!patch) return std::nullopt;
  const auto found = patch->align(right[0], {pixel.x() - expected_disparity_px, pixel.y()}, PatchTemplate::Search::kRow, kReach_px);
  if (!found) return std::nullopt;
  const StereoMatch match{pixel.x() - found->position.x(), gradient, found->correlation, found->variance.x()};
  if (!accepts(match)) return std::nullopt;
  return match;
}

bool StereoMatcher::accepts(const StereoMatch& match) const {
  return match.disparity_px >= range_.from_px && match.disparity_px <= range_.to_px &&
         match.correlation >= smallest_correlation_;
}

}  // namespace panvo::vision

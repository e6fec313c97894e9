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
constexpr double kDisparitySettled_px = 0.01;
constexpr double kMaxDisparityStep_px = 2.0;
constexpr double kGradientSigma =
    0.3;                        // prior: 0 for fronto-parallel walls, baseline / camera height (0.1 to 0.35) for roads
constexpr double kNoise = 4.0;  // grey levels: weight of that prior against the image
constexpr double kCoarseCorrelation = 0.6;  // with a window that ignores the slant
constexpr double kReach_px = 3.0;
constexpr double kRowReach_px = 3.0;     // from the row predicted by the current misalignment
constexpr double kMaxRowSigma_px = 0.5;  // above: too little vertical gradient

// An image row at a fractional v, linearly interpolated.
class Row {
 public:
  Row(const cv::Mat& image, double v)
      : upper_(image.ptr<uchar>(static_cast<int>(v))),
        lower_(upper_ + image.step[0]),
        fraction_(static_cast<float>(v - std::floor(v))) {}

  float operator()(float u) const {
    const int column = static_cast<int>(u);
    const float fu = u - static_cast<float>(column);
    const float above =
        static_cast<float>(upper_[column]) + fu * static_cast<float>(upper_[column + 1] - upper_[column]);
    const float below =
        static_cast<float>(lower_[column]) + fu * static_cast<float>(lower_[column + 1] - lower_[column]);
    return above + fraction_ * (below - above);
  }

 private:
  const uchar* upper_;
  const uchar* lower_;
  float fraction_;
};

bool inside(const cv::Mat& image, double u, double v) {
  return u >= 0.0 && v >= 0.0 && u < image.cols - 1 && v < image.rows - 1;
}

// Gauss-Newton for gain, offset, disparity and its two gradients, using the row gradients of the left patch.
class SlantedPatch {
 public:
  static std::optional<SlantedPatch> sample(const cv::Mat& left, const Eigen::Vector2d& centre) {
    if (!inside(left, centre.x() - kHalf - 1.1, centre.y() - kHalf) ||
        !inside(left, centre.x() + kHalf + 1.1, centre.y() + kHalf)) {
      return std::nullopt;
    }
    SlantedPatch patch(centre);
    Basis mean = Basis::Zero();
    for (int y = 0; y < kSize; ++y) {
      const Row row(left, centre.y() + y - kHalf);
      for (int x = 0; x < kSize; ++x) {
        const auto u = static_cast<float>(centre.x() + x - kHalf);
        const float slope = 0.5F * (row(u + 1.0F) - row(u - 1.0F));
        Basis& basis = patch.basis_[static_cast<size_t>(y * kSize + x)];
        basis = Basis(row(u), slope, slope * static_cast<float>(x - kHalf), slope * static_cast<float>(y - kHalf));
        mean += basis / (kSize * kSize);
      }
    }
    patch.normal_.setZero();
    for (Basis& b : patch.basis_) {
      b -= mean;
      patch.normal_ += (b * b.transpose()).cast<double>();
    }
    return patch;
  }

  // Refines `match` (px of this level) in place; false if the patch leaves the image, contrast is too low or inverted,
  // or a step is too large. `shift`: displacement of the right image relative to an aligned one.
  bool align(const cv::Mat& right, const Eigen::Vector2d& shift, StereoMatch& match) const {
    const Eigen::Vector2d origin = centre_ + shift;
    constexpr double kPriorWeight = kNoise * kNoise / (kGradientSigma * kGradientSigma);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      if (!fits(right, origin, match)) return false;
      float sum = 0.0F, square = 0.0F;
      Basis on_basis = Basis::Zero();
      const auto step_u = static_cast<float>(1.0 - match.gradient.x());
      for (int y = 0; y < kSize; ++y) {
        const Row row(right, origin.y() + y - kHalf);
        auto u = static_cast<float>(origin.x() - match.disparity_px - match.gradient.y() * (y - kHalf)) -
                 static_cast<float>(kHalf) * step_u;
        for (int x = 0; x < kSize; ++x, u += step_u) {
          const float value = row(u);
          sum += value;
          square += value * value;
          on_basis += value * basis_[static_cast<size_t>(y * kSize + x)];
        }
      }
      const Eigen::Vector4d projection = on_basis.cast<double>();
      const double variation = square - static_cast<double>(sum) * sum / (kSize * kSize);
      match.correlation = projection.x() / std::sqrt(std::max(variation * normal_(0, 0), 1e-12));

      Eigen::Matrix4d normal = normal_;
      Eigen::Vector4d target = projection;
      normal(1, 1) += 1e-6 * normal_(0, 0);
      normal.diagonal().tail<2>().array() += kPriorWeight;
      target.tail<2>() -= kPriorWeight * match.gradient;
      const Eigen::Matrix4d inverse = normal.inverse();
      const Eigen::Vector4d solution = inverse * target;
      const double gain = solution.x();
      if (!(gain > 0.25) || !solution.allFinite()) return false;
      const double step = solution.y() / gain;
      if (std::abs(step) > kMaxDisparityStep_px) return false;
      match.disparity_px += step;
      match.gradient += solution.tail<2>() / gain;
      const double residual = std::max(0.0, variation - solution.dot(projection));
      match.variance_px2 = residual / ((kSize * kSize - 5) * gain * gain) * inverse(1, 1);
      if (std::abs(step) < kDisparitySettled_px) break;
    }
    return true;
  }

 private:
  using Basis = Eigen::Vector4f;  // intensity, du, du * x, du * y; means removed

  explicit SlantedPatch(const Eigen::Vector2d& centre) : centre_(centre) {}

  // Whether all corners of the matched patch lie in the image.
  static bool fits(const cv::Mat& right, const Eigen::Vector2d& origin, const StereoMatch& match) {
    for (const double y : {-kHalf, kHalf}) {
      for (const double x : {-kHalf, kHalf}) {
        const double shift = match.disparity_px + match.gradient.dot(Eigen::Vector2d(x, y));
        // Margin of one column: steps are accumulated in single precision.
        if (!inside(right, origin.x() + x - shift - 1.0, origin.y() + y)) return false;
        if (!inside(right, origin.x() + x - shift + 1.0, origin.y() + y)) return false;
      }
    }
    return true;
  }

  Eigen::Vector2d centre_;
  std::array<Basis, kSize * kSize> basis_;
  Eigen::Matrix4d normal_;
};

/// The neighbourhood of a left pixel, warped to the right image for the given slant.
std::optional<PatchTemplate> warped_patch(const ImagePyramid& left, const Eigen::Vector2d& pixel,
                                          const Eigen::Vector2d& gradient) {
  Eigen::Matrix2d right_from_left;
  right_from_left << 1.0 - gradient.x(), -gradient.y(), 0.0, 1.0;
  if (right_from_left(0, 0) < 0.25) return std::nullopt;  // almost edge-on
  return PatchTemplate::sample(left[0], pixel, right_from_left.inverse());
}

}  // namespace

std::optional<StereoMatch> StereoMatcher::search(const ImagePyramid& left, const ImagePyramid& right,
                                                 const Eigen::Vector2d& pixel) const {
  const int coarse = std::min(1, left.levels() - 1);
  const double scale = 1 << coarse;
  const cv::Point place(static_cast<int>(std::lround(pixel.x() / scale)),
                        static_cast<int>(std::lround(pixel.y() / scale)));
  const Eigen::Vector2i shift_here = (shift(pixel, 0.0) / scale).array().round().cast<int>();
  const auto found = search_row(left[coarse], right[coarse], place, shift_here.y(),
                                static_cast<int>(std::floor(range_.from_px / scale)) - shift_here.x(),
                                static_cast<int>(std::ceil(range_.to_px / scale)) - shift_here.x(), kCoarseCorrelation);
  if (!found) return std::nullopt;

  StereoMatch match;
  match.disparity_px = *found + shift_here.x();
  for (int level = coarse; level >= 0; --level) {
    const auto patch = SlantedPatch::sample(left[level], pixel / (1 << level));
    // If the coarse patch fails, e.g. near the border, the finer one is still tried.
    StereoMatch improved = match;
    const double level_px = 1 << level;
    if (patch && patch->align(right[level], shift(pixel, match.disparity_px * level_px) / level_px, improved)) {
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
  if (!patch || !patch->align(right[0], shift(pixel, expected_disparity_px), match) || !accepts(match)) {
    return std::nullopt;
  }
  return match;
}

std::optional<StereoMatch> StereoMatcher::refine(const ImagePyramid& left, const ImagePyramid& right,
                                                 const Eigen::Vector2d& pixel, double expected_disparity_px,
                                                 const Eigen::Vector2d& gradient) const {
  const auto patch = warped_patch(left, pixel, gradient);
  if (!patch) return std::nullopt;
  const Eigen::Vector2d shift_here = shift(pixel, expected_disparity_px), origin = pixel + shift_here;
  const auto found =
      patch->align(right[0], {origin.x() - expected_disparity_px, origin.y()}, PatchTemplate::Search::kRow, kReach_px);
  if (!found) return std::nullopt;
  const StereoMatch match{origin.x() - found->position.x(), gradient, found->correlation, found->variance.x()};
  if (!accepts(match)) return std::nullopt;
  return match;
}

std::optional<RowError> StereoMatcher::row_error(const ImagePyramid& left, const ImagePyramid& right,
                                                 const Eigen::Vector2d& pixel, const StereoMatch& match) const {
  const auto patch = warped_patch(left, pixel, match.gradient);
  if (!patch) return std::nullopt;
  const Eigen::Vector2d ideal(pixel.x() - match.disparity_px, pixel.y());
  const auto found =
      patch->align(right[0], ideal + shift(pixel, match.disparity_px), PatchTemplate::Search::kPlane, kRowReach_px);
  if (!found || found->correlation < min_correlation_) return std::nullopt;
  const double sigma_px = std::sqrt(found->variance.y());
  if (sigma_px > kMaxRowSigma_px) return std::nullopt;
  return RowError{ideal, found->position.y() - pixel.y(), sigma_px};
}

bool StereoMatcher::accepts(const StereoMatch& match) const {
  return match.disparity_px >= range_.from_px && match.disparity_px <= range_.to_px &&
         match.correlation >= min_correlation_;
}

}  // namespace panvo::vision

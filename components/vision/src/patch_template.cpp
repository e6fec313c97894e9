// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/patch_template.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

#include "lane_sum.hpp"

namespace panvo::vision {
namespace {

constexpr int kMaxIterations = 12;
constexpr double kSettled_px = 0.01;
constexpr double kMaxStep_px = 1.5;  // beyond, the linearisation is not valid
constexpr double kCorrelation =
    3.0;  // interpolation correlates pixel noise: residuals shrink, the position error does not
constexpr double kMinGain = 0.25;          // fainter patches are rejected
constexpr double kMinPatchContrast = 2.0;  // grey levels, standard deviation: noise level of an 8-bit image

// Image positions in fixed point, 1/65536 px: sampling dominates the run time and is fastest with integers.
constexpr int kPlaceBits = 16;
constexpr int kWeightBits = 10;
constexpr double kRounding_px = 0.01;  // upper bound of the accumulated rounding over a row

int to_place(double px) { return static_cast<int>(std::lround(px * (1 << kPlaceBits))); }

float bilinear(const cv::Mat& image, int u, int v) {
  constexpr int kMask = (1 << kWeightBits) - 1;
  const int fu = (u >> (kPlaceBits - kWeightBits)) & kMask, fv = (v >> (kPlaceBits - kWeightBits)) & kMask;
  const uchar* upper = image.data +
                       static_cast<std::ptrdiff_t>(v >> kPlaceBits) * static_cast<std::ptrdiff_t>(image.step[0]) +
                       (u >> kPlaceBits);
  const uchar* lower = upper + image.step[0];
  const int above = (upper[0] << kWeightBits) + fu * (upper[1] - upper[0]);
  const int below = (lower[0] << kWeightBits) + fu * (lower[1] - lower[0]);
  return static_cast<float>((above << kWeightBits) + fv * (below - above)) * (1.0F / (1 << (2 * kWeightBits)));
}

// Loads via a copy (no extra cost): OpenCV's load would read a misaligned integer.
cv::v_float32x4 load_four(const uchar* pixels) {
  alignas(4) std::array<uchar, 4> four;
  std::memcpy(four.data(), pixels, four.size());
  return cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(four.data())));
}

}  // namespace

std::optional<PatchTemplate> PatchTemplate::sample(const cv::Mat& image, const Eigen::Vector2d& centre,
                                                   const Eigen::Matrix2d& source_from_target) {
  constexpr int kBordered = kSize + 2;  // one more pixel on each side, for central differences
  constexpr double kReach = 0.5 * (kBordered - 1);
  const Eigen::Vector2d extent = (kReach * source_from_target.cwiseAbs().rowwise().sum()).array() + kRounding_px;
  if (!(centre.x() - extent.x() >= 0.0 && centre.y() - extent.y() >= 0.0 && centre.x() + extent.x() < image.cols - 1 &&
        centre.y() + extent.y() < image.rows - 1)) {
    return std::nullopt;
  }
  const Eigen::Vector2d origin = centre - source_from_target * Eigen::Vector2d::Constant(kReach);
  const int across_u = to_place(source_from_target(0, 0)), across_v = to_place(source_from_target(1, 0));
  std::array<float, kBordered * kBordered> samples;
  for (int row = 0; row < kBordered; ++row) {
    int u = to_place(origin.x() + source_from_target(0, 1) * row);
    int v = to_place(origin.y() + source_from_target(1, 1) * row);
    for (int column = 0; column < kBordered; ++column, u += across_u, v += across_v) {
      samples[static_cast<size_t>(row * kBordered + column)] = bilinear(image, u, v);
    }
  }
  PatchTemplate patch;
  if (!patch.prepare(samples)) return std::nullopt;
  return patch;
}

bool PatchTemplate::prepare(const std::array<float, (kSize + 2) * (kSize + 2)>& samples) {
  constexpr int kBordered = kSize + 2;
  std::array<float, 3> sums{};
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float* at = samples.data() + (row + 1) * kBordered + column + 1;
      const auto pixel = static_cast<size_t>(row * kSize + column);
      basis_[0][pixel] = at[0];
      basis_[1][pixel] = 0.5F * (at[1] - at[-1]);
      basis_[2][pixel] = 0.5F * (at[kBordered] - at[-kBordered]);
      for (size_t k = 0; k < 3; ++k) sums[k] += basis_[k][pixel];
    }
  }
  Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
  for (size_t pixel = 0; pixel < kPixels; ++pixel) {
    for (size_t k = 0; k < 3; ++k) basis_[k][pixel] -= sums[k] / kPixels;
    const Eigen::Vector3f b(basis_[0][pixel], basis_[1][pixel], basis_[2][pixel]);
    normal += b * b.transpose();
  }
  energy_ = normal(0, 0);
  if (energy_ < kPixels * kMinPatchContrast * kMinPatchContrast) return false;
  const Eigen::Matrix3d normal_plane = normal.cast<double>();
  // The damping allows a row search for a template without gradient along v (a vertical edge).
  const Eigen::Matrix3d damping = (1e-6 * energy_ * Eigen::Vector3d(0.0, 1.0, 1.0)).asDiagonal();
  inverse_plane_ = (normal_plane + damping).inverse();
  inverse_row_ = (normal_plane + damping).topLeftCorner<2, 2>().inverse();
  return inverse_plane_.allFinite() && inverse_row_.allFinite();
}

PatchTemplate::Projections PatchTemplate::project(const cv::Mat& image, double left, double top) const {
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  const cv::v_float32x4 right_weight = cv::v_setall_f32(static_cast<float>(left - column));
  const cv::v_float32x4 lower_weight = cv::v_setall_f32(static_cast<float>(top - row));
  cv::v_float32x4 sum = cv::v_setzero_f32(), square = sum;
  std::array<cv::v_float32x4, 3> on_basis{sum, sum, sum};
  std::array<cv::v_float32x4, kSize / 4> above;
  for (int y = 0; y <= kSize; ++y) {
    const uchar* pixels = image.ptr<uchar>(row + y) + column;
    for (int block = 0; block < kSize / 4; ++block) {
      const auto grey = [pixels, block](int shift) { return load_four(pixels + 4 * block + shift); };
      const cv::v_float32x4 here = grey(0);
      const cv::v_float32x4 across = here + right_weight * (grey(1) - here);
      if (y > 0) {
        const cv::v_float32x4 upper = above[static_cast<size_t>(block)];
        const cv::v_float32x4 value = upper + lower_weight * (across - upper);
        sum += value;
        square += value * value;
        const int pixel = (y - 1) * kSize + 4 * block;
        for (size_t k = 0; k < 3; ++k) on_basis[k] += value * cv::v_load(basis_[k].data() + pixel);
      }
      above[static_cast<size_t>(block)] = across;
    }
  }
  return {lane_sum(sum), lane_sum(square), {lane_sum(on_basis[0]), lane_sum(on_basis[1]), lane_sum(on_basis[2])}};
}

std::optional<PatchAlignment> PatchTemplate::align(const cv::Mat& image, const Eigen::Vector2d& start, Search search,
                                                   double reach_px) const {
  constexpr double kHalf = 0.5 * (kSize - 1);
  Eigen::Vector2d position = start;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const double left = position.x() - kHalf, top = position.y() - kHalf;
    if (!(left >= 0.0 && top >= 0.0 && left + kSize < image.cols - 1 && top + kSize < image.rows - 1))
      return std::nullopt;
    const Projections seen = project(image, left, top);

    // seen = gain * (template shifted by e) + offset, linear in (gain, gain * e).
    Eigen::Vector3d solution = Eigen::Vector3d::Zero();
    if (search == Search::kPlane) {
      solution = inverse_plane_ * seen.on_basis;
    } else {
      solution.head<2>() = inverse_row_ * seen.on_basis.head<2>();
    }
    const double gain = solution.x();
    if (!(gain > kMinGain)) return std::nullopt;
    Eigen::Vector2d step = -solution.tail<2>() / gain;
    const double length = step.norm();
    if (length > kMaxStep_px) step *= kMaxStep_px / length;
    position += step;
    if ((position - start).squaredNorm() > reach_px * reach_px) return std::nullopt;
    if (length > kSettled_px) continue;

    const double variation = seen.square - seen.intensity * seen.intensity / kPixels;
    const double residual = std::max(0.0, variation - solution.dot(seen.on_basis));
    const double noise = kCorrelation * residual / ((kPixels - 4) * gain * gain);
    PatchAlignment alignment;
    alignment.position = position;
    alignment.correlation = seen.on_basis.x() / std::sqrt(std::max(variation * energy_, 1e-12));
    alignment.variance = noise * (search == Search::kPlane ? Eigen::Vector2d(inverse_plane_(1, 1), inverse_plane_(2, 2))
                                                           : Eigen::Vector2d(inverse_row_(1, 1), 0.0));
    return alignment;
  }
  return std::nullopt;
}

}  // namespace panvo::vision

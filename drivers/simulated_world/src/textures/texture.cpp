// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/texture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace panvo::simulated_world {
namespace {

/// The sRGB transfer function, from 0..255 to linear 0..1.
std::array<float, 256> make_linear_from_srgb() {
  std::array<float, 256> table{};
  for (int value = 0; value < 256; ++value) {
    const double encoded = value / 255.0;
    table[value] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
  }
  return table;
}

/// Linear colour premultiplied by alpha, CV_32FC4.
cv::Mat4f premultiplied(const cv::Mat& albedo) {
  static const std::array<float, 256> linear = make_linear_from_srgb();
  cv::Mat4f result(albedo.size());
  for (int row = 0; row < albedo.rows; ++row) {
    const auto* from = albedo.ptr<cv::Vec4b>(row);
    auto* to = result.ptr<cv::Vec4f>(row);
    for (int column = 0; column < albedo.cols; ++column) {
      // A small weight even in holes, so that a level that consists only of holes keeps their colour.
      const float alpha = std::max(from[column][3] / 255.0f, 1e-4f);
      to[column] = cv::Vec4f(linear[from[column][0]], linear[from[column][1]], linear[from[column][2]], 1.0f) * alpha;
    }
  }
  return result;
}

cv::Mat4f halved(const cv::Mat4f& level) {
  const int row_step = level.rows > 1 ? 2 : 1;
  const int column_step = level.cols > 1 ? 2 : 1;
  cv::Mat4f result(level.rows / row_step, level.cols / column_step);
  for (int row = 0; row < result.rows; ++row) {
    const cv::Vec4f* upper = level[row * row_step];
    const cv::Vec4f* lower = level[row * row_step + row_step - 1];
    for (int column = 0; column < result.cols; ++column) {
      const int left = column * column_step;
      const int right = left + column_step - 1;
      result(row, column) = (upper[left] + upper[right] + lower[left] + lower[right]) * 0.25f;
    }
  }
  return result;
}

double coverage(const cv::Mat4f& level, float threshold) {
  const auto covered = std::count_if(level.begin(), level.end(), [&](const cv::Vec4f& t) { return t[3] >= threshold; });
  return static_cast<double>(covered) / static_cast<double>(level.total());
}

/// The alpha threshold at which the interpolated level has the same coverage as the full picture at 0.5. Otherwise,
/// leaves averaged with the gaps between them would fall below it and trees would dissolve with distance [Castano
/// 2010].
float threshold_of_coverage(const cv::Mat4f& level, double wanted) {
  constexpr int kFiner = 4;
  cv::Mat1f alpha;
  cv::extractChannel(level, alpha, 3);
  cv::copyMakeBorder(alpha, alpha, 1, 1, 1, 1, cv::BORDER_WRAP);
  cv::resize(alpha, alpha, {}, kFiner, kFiner, cv::INTER_LINEAR);
  std::vector<float> values;
  for (int row = kFiner; row < alpha.rows - kFiner; ++row) {
    values.insert(values.end(), alpha[row] + kFiner, alpha[row] + alpha.cols - kFiner);
  }
  const auto place = values.begin() + static_cast<std::ptrdiff_t>((1.0 - wanted) * static_cast<double>(values.size()));
  if (place == values.end()) return 1.0f;
  std::ranges::nth_element(values, place);
  return std::clamp(*place, 0.02f, 1.0f);
}

/// Colour and alpha as square roots in 8 bits: as fine as sRGB in dark areas, and decoded by squaring.
std::uint8_t encoded(float value) {
  return static_cast<std::uint8_t>(255.0f * std::sqrt(std::clamp(value, 0.0f, 1.0f)) + 0.5f);
}

/// Encodes level 0 by table lookup.
void encode_finest(const cv::Mat& albedo, std::uint8_t* to) {
  static const auto tables = [] {
    const std::array<float, 256> linear = make_linear_from_srgb();
    std::array<std::array<std::uint8_t, 256>, 2> entries{};
    for (int value = 0; value < 256; ++value) {
      entries[0][value] = encoded(linear[value]);
      entries[1][value] = encoded(static_cast<float>(value) / 255.0f);
    }
    return entries;
  }();
  for (int row = 0; row < albedo.rows; ++row) {
    const auto* from = albedo.ptr<cv::Vec4b>(row);
    for (int column = 0; column < albedo.cols; ++column) {
      for (int channel = 0; channel < 4; ++channel) *to++ = tables[channel / 3][from[column][channel]];
    }
  }
}

/// log2 to 0.01, enough to choose a level of detail.
float fast_log2(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
  const float mantissa = std::bit_cast<float>((bits & 0x007fffffu) | 0x3f800000u);
  return exponent + (-0.33582878f * mantissa + 2.0f) * mantissa - 1.65871f;
}

int fast_floor(float value) {
  const int truncated = static_cast<int>(value);
  return truncated - static_cast<int>(value < static_cast<float>(truncated));
}

cv::v_float32x4 texel(const std::uint8_t* rgba) {
  const cv::v_float32x4 root = cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(rgba)));
  return root * root;
}

cv::v_float32x4 bilinear(const std::uint8_t* texels, int column_mask, int row_mask, float u, float v) {
  const float x = u * static_cast<float>(column_mask + 1) - 0.5f;
  const float y = v * static_cast<float>(row_mask + 1) - 0.5f;
  const int column = fast_floor(x);
  const int row = fast_floor(y);
  const float right = x - static_cast<float>(column);
  const float down = y - static_cast<float>(row);
  const int left_byte = (column & column_mask) * 4;
  const int right_byte = ((column + 1) & column_mask) * 4;
  const std::size_t stride = static_cast<std::size_t>(column_mask + 1) * 4;
  const std::uint8_t* upper = texels + (row & row_mask) * stride;
  const std::uint8_t* lower = texels + ((row + 1) & row_mask) * stride;
  const cv::v_float32x4 up_left = texel(upper + left_byte);
  const cv::v_float32x4 up = up_left + (texel(upper + right_byte) - up_left) * cv::v_setall_f32(right);
  const cv::v_float32x4 low_left = texel(lower + left_byte);
  const cv::v_float32x4 low = low_left + (texel(lower + right_byte) - low_left) * cv::v_setall_f32(right);
  return up + (low - up) * cv::v_setall_f32(down);
}

}  // namespace

Texture::Texture(const cv::Mat& albedo) {
  if (albedo.type() != CV_8UC4 || !std::has_single_bit(static_cast<unsigned>(albedo.cols)) ||
      !std::has_single_bit(static_cast<unsigned>(albedo.rows))) {
    throw std::invalid_argument("a texture must be CV_8UC4 with powers of two as width and height");
  }
  cv::Mat4f level = premultiplied(albedo);
  const bool has_holes = coverage(level, 0.5f) < 1.0;
  const double wanted = coverage(level, 0.5f);
  std::size_t texels = 0;
  for (int width = albedo.cols, height = albedo.rows;;
       width = std::max(width / 2, 1), height = std::max(height / 2, 1)) {
    levels_.push_back({static_cast<std::uint32_t>(texels * 4), width - 1, height - 1});
    texels += static_cast<std::size_t>(width) * height;
    if (width == 1 && height == 1) break;
  }
  texels_.resize(texels * 4);

  const cv::Scalar total = cv::mean(level);
  mean_ = Eigen::Vector4d(total[0] / total[3], total[1] / total[3], total[2] / total[3], total[3]).cast<float>();
  encode_finest(albedo, texels_.data());
  for (std::size_t number = 1; number < levels_.size(); ++number) {
    level = halved(level);
    const float alpha_scale = has_holes ? 0.5f / threshold_of_coverage(level, wanted) : 1.0f;
    std::uint8_t* to = texels_.data() + levels_[number].offset;
    for (const cv::Vec4f& from : level) {
      const float whole = 1.0f / from[3];
      for (int channel = 0; channel < 3; ++channel) *to++ = encoded(from[channel] * whole);
      *to++ = encoded(from[3] * alpha_scale);
    }
  }
  if (has_holes) cv::extractChannel(albedo, alpha_, 3);
}

Eigen::Vector4f Texture::sample(const Eigen::Vector2f& uv, const Eigen::Vector2f& du, const Eigen::Vector2f& dv,
                                int taps) const {
  // Approximate the pixel's parallelogram by an ellipse: the eigenvalues of J J' are its squared half axes, in texels.
  const auto columns = static_cast<float>(levels_.front().column_mask + 1);
  const auto rows = static_cast<float>(levels_.front().row_mask + 1);
  const float ux = du.x() * columns, uy = du.y() * rows, vx = dv.x() * columns, vy = dv.y() * rows;
  const float xx = ux * ux + vx * vx;
  const float yy = uy * uy + vy * vy;
  const float xy = ux * uy + vx * vy;
  const float middle = 0.5f * (xx + yy);
  const float half_difference = 0.5f * (xx - yy);
  const float spread = std::sqrt(half_difference * half_difference + xy * xy);
  const float longer = std::min(1e12f, middle + spread);  // bounds as first arguments: they replace NaN, too
  const float shorter = std::max(1e-12f, middle - spread);

  int probes = 1;
  float width = longer;  // squared width covered by one probe
  // A footprint over many periods gives the mean for any shape.
  constexpr float kVeryLong = 1e9f;
  if (taps > 1 && longer > shorter && longer < kVeryLong) {
    const float ratio = std::sqrt(longer / shorter);
    probes = longer <= 1.0f ? 1 : std::min(taps, static_cast<int>(std::min(ratio, 64.0f) + 0.999f));
    width = std::max(shorter, longer / static_cast<float>(probes * probes));
  }
  const float detail =
      std::clamp(0.5f * fast_log2(std::max(1.0f, width)), 0.0f, static_cast<float>(levels_.size() - 1));
  const int fine = static_cast<int>(detail);
  const float coarse_share = detail - static_cast<float>(fine);
  const Level& level = levels_[fine];
  const bool one_level = coarse_share < 0.02f || fine + 1 == static_cast<int>(levels_.size());

  // Steps in uv along the longer axis.
  float step_u = 0.0f;
  float step_v = 0.0f;
  if (probes > 1) {
    // The form of the eigenvector without cancellation.
    const float x = half_difference >= 0.0f ? half_difference + spread : xy;
    const float y = half_difference >= 0.0f ? xy : spread - half_difference;
    const float scale = std::sqrt(longer / std::max(x * x + y * y, 1e-20f)) / static_cast<float>(probes);
    step_u = x * scale / columns;
    step_v = y * scale / rows;
  }
  const float first = -0.5f * static_cast<float>(probes - 1);
  cv::v_float32x4 sum = cv::v_setzero_f32();
  for (int probe = 0; probe < probes; ++probe) {
    const float along = first + static_cast<float>(probe);
    const float u = uv.x() + along * step_u;
    const float v = uv.y() + along * step_v;
    const cv::v_float32x4 sharp = bilinear(texels_.data() + level.offset, level.column_mask, level.row_mask, u, v);
    sum = sum + sharp;
    if (one_level) continue;
    const Level& next = levels_[fine + 1];
    const cv::v_float32x4 soft = bilinear(texels_.data() + next.offset, next.column_mask, next.row_mask, u, v);
    sum = sum + (soft - sharp) * cv::v_setall_f32(coarse_share);
  }
  Eigen::Vector4f result;
  cv::v_store(result.data(), sum * cv::v_setall_f32(1.0f / (255.0f * 255.0f * static_cast<float>(probes))));
  return result;
}

float Texture::alpha(const Eigen::Vector2f& uv) const {
  if (alpha_.empty()) return 1.0f;
  const float x = uv.x() * static_cast<float>(alpha_.cols) - 0.5f;
  const float y = uv.y() * static_cast<float>(alpha_.rows) - 0.5f;
  const int column = fast_floor(x);
  const int row = fast_floor(y);
  const float right = x - static_cast<float>(column);
  const float down = y - static_cast<float>(row);
  const int left_column = column & (alpha_.cols - 1);
  const int right_column = (column + 1) & (alpha_.cols - 1);
  const std::uint8_t* upper = alpha_[row & (alpha_.rows - 1)];
  const std::uint8_t* lower = alpha_[(row + 1) & (alpha_.rows - 1)];
  const float up = upper[left_column] + right * static_cast<float>(upper[right_column] - upper[left_column]);
  const float low = lower[left_column] + right * static_cast<float>(lower[right_column] - lower[left_column]);
  return (up + down * (low - up)) * (1.0f / 255.0f);
}

}  // namespace panvo::simulated_world

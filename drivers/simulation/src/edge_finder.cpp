// SPDX-License-Identifier: Apache-2.0
#include "edge_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shade_packet.hpp"

namespace panvo::simulation {
namespace {

constexpr int kSameDirection = static_cast<int>(0.906 * 127 * 127);  // cosine of 25 degrees
constexpr float kRangeJump = 0.02f;  // of the inverse range, off the line of its neighbours
constexpr float kContrast = 0.03f;   // of the sum of both
constexpr float kDarkness = 0.004f;  // radiance: below it nothing stands out
constexpr std::uint32_t kSunny = 0x80000000u;

float brightness(const cv::Mat& radiance, int row, int column) {
  const auto* colour = radiance.ptr<float>(row, column);
  return 0.25f * colour[0] + 0.5f * colour[1] + 0.25f * colour[2];
}

bool faces_elsewhere(std::uint32_t a, std::uint32_t b) {
  const auto part = [](std::uint32_t packed, int shift) {
    return static_cast<int>(static_cast<std::int8_t>(packed >> shift & 0xffu));
  };
  const int cosine = part(a, 0) * part(b, 0) + part(a, 8) * part(b, 8) + part(a, 16) * part(b, 16);
  return cosine < kSameDirection;
}

}  // namespace

void find_edges(const SeenSurfaces& seen, int first_row, int end_row, cv::Mat& is_edge) {
  const int width = seen.key.cols;
  const int height = seen.key.rows;
  const auto column_at = [&](int column) {
    if (seen.wraps) return (column + width) % width;
    return std::clamp(column, 0, width - 1);
  };
  for (int row = first_row; row < end_row; ++row) {
    auto* marked = is_edge.ptr<std::uint8_t>(row);
    const int above = std::max(row - 1, 0);
    const int below = std::min(row + 1, height - 1);
    for (int column = 0; column < width; ++column) {
      const auto key = seen.key.at<std::int32_t>(row, column);
      const auto normal = static_cast<std::uint32_t>(seen.normal.at<std::int32_t>(row, column));
      const float here = seen.inverse_range.at<float>(row, column);
      const int left = column_at(column - 1);
      const int right = column_at(column + 1);
      const float bend = std::max(
          std::abs(2.0f * here - seen.inverse_range.at<float>(row, left) - seen.inverse_range.at<float>(row, right)),
          std::abs(2.0f * here - seen.inverse_range.at<float>(above, column) -
                   seen.inverse_range.at<float>(below, column)));
      const bool is_leaf = (normal >> 24 & kHasHoles) != 0;
      const bool jumps = bend > kRangeJump * here || is_leaf;
      struct {
        std::uint32_t all = 3;  // bit 0: all in the sun, bit 1: none
        void add(std::int32_t of_key, std::uint32_t of_normal) {
          if (of_key != 0) all &= (of_normal & kSunny) != 0 ? 1u : 2u;
        }
      } counted_sun;
      counted_sun.add(key, normal);
      const float light = brightness(seen.radiance, row, column);
      bool found = false;
      const auto compare = [&](int other_row, int other_column) {
        const auto other_normal = static_cast<std::uint32_t>(seen.normal.at<std::int32_t>(other_row, other_column));
        const auto other_key = seen.key.at<std::int32_t>(other_row, other_column);
        counted_sun.add(other_key, other_normal);
        const bool differs = jumps || other_key != key || ((normal ^ other_normal) & kSunny) != 0 ||
                             (key != 0 && faces_elsewhere(normal, other_normal));
        if (!differs) return;
        const float other_light = brightness(seen.radiance, other_row, other_column);
        found = found || std::abs(light - other_light) > kContrast * (light + other_light) + kDarkness;
      };
      compare(row, left);
      compare(row, right);
      compare(above, column);
      compare(below, column);
      if (!found) {
        marked[column] = 0;
        continue;
      }
      const std::uint32_t together = counted_sun.all;
      marked[column] = static_cast<std::uint8_t>(kCrossed | (is_leaf ? kInLeaves : 0) |
                                                 (together == 1 ? kAllInSun : 0) | (together == 2 ? kAllInShadow : 0));
    }
  }
}

}  // namespace panvo::simulation

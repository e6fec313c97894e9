// SPDX-License-Identifier: Apache-2.0
#include "edge_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shade_packet.hpp"

namespace panvo::simulated_world {
namespace {

constexpr int kSameDirection = static_cast<int>(0.906 * 127 * 127);  // cosine of 25 degrees
constexpr float kRangeJump = 0.02f;  // relative deviation of the inverse range from its neighbours' line
constexpr float kContrast = 0.04f;   // relative to the sum of both
constexpr float kDarkness = 0.004f;  // radiance below which differences are not visible

float brightness(const float* colour) { return 0.25f * colour[0] + 0.5f * colour[1] + 0.25f * colour[2]; }

bool faces_elsewhere(std::uint32_t a, std::uint32_t b) {
  const auto part = [](std::uint32_t packed, int shift) {
    return static_cast<int>(static_cast<std::int8_t>(packed >> shift & 0xffu));
  };
  const int cosine = part(a, 0) * part(b, 0) + part(a, 8) * part(b, 8) + part(a, 16) * part(b, 16);
  return cosine < kSameDirection;
}

/// A row of SeenSurfaces.
struct Row {
  Row(const SeenSurfaces& seen, int row)
      : radiance(seen.radiance.ptr<float>(row)),
        inverse_range(seen.inverse_range.ptr<float>(row)),
        key(seen.key.ptr<std::uint32_t>(row)),
        normal(seen.normal.ptr<std::uint32_t>(row)) {}
  const float* radiance;
  const float* inverse_range;
  const std::uint32_t* key;
  const std::uint32_t* normal;
};

}  // namespace

void find_edges(const SeenSurfaces& seen, int first_row, int end_row, cv::Mat& is_edge) {
  const int width = seen.key.cols;
  const int height = seen.key.rows;
  for (int row = first_row; row < end_row; ++row) {
    auto* marked = is_edge.ptr<std::uint8_t>(row);
    const Row here(seen, row);
    const Row above(seen, std::max(row - 1, 0));
    const Row below(seen, std::min(row + 1, height - 1));
    for (int column = 0; column < width; ++column) {
      const int left = column > 0 ? column - 1 : seen.wraps ? width - 1 : 0;
      const int right = column + 1 < width ? column + 1 : seen.wraps ? 0 : column;
      const std::uint32_t key = here.key[column];
      const std::uint32_t normal = here.normal[column];
      const float nearness = here.inverse_range[column];
      const float across = std::abs(2.0f * nearness - here.inverse_range[left] - here.inverse_range[right]);
      const float down = std::abs(2.0f * nearness - above.inverse_range[column] - below.inverse_range[column]);
      const bool is_leaf = (normal >> 24 & kHasHoles) != 0;
      const bool jumps = std::max(across, down) > kRangeJump * nearness || is_leaf;
      marked[column] = 0;
      const bool is_same = here.key[left] == key && here.key[right] == key && above.key[column] == key &&
                           below.key[column] == key && here.normal[left] == normal && here.normal[right] == normal &&
                           above.normal[column] == normal && below.normal[column] == normal;
      if (is_same && !jumps) continue;

      const float light = brightness(here.radiance + 3 * column);
      bool found = false;
      std::uint32_t sun = key == 0 ? 3u : (normal & kSunny) != 0 ? 1u : 2u;  // bit 0: all sunlit, bit 1: all in shadow
      const auto compare = [&](const Row& other, int at) {
        if (other.key[at] != 0) sun &= (other.normal[at] & kSunny) != 0 ? 1u : 2u;
        const bool differs = jumps || other.key[at] != key || ((normal ^ other.normal[at]) & kSunny) != 0 ||
                             (key != 0 && faces_elsewhere(normal, other.normal[at]));
        if (!differs) return;
        const float other_light = brightness(other.radiance + 3 * at);
        found = found || std::abs(light - other_light) > kContrast * (light + other_light) + kDarkness;
      };
      compare(here, left);
      compare(here, right);
      compare(above, column);
      compare(below, column);
      if (!found) continue;
      marked[column] = static_cast<std::uint8_t>(kCrossed | (is_leaf ? kInLeaves : 0) | (sun == 1 ? kAllInSun : 0) |
                                                 (sun == 2 ? kAllInShadow : 0));
    }
  }
}

}  // namespace panvo::simulated_world

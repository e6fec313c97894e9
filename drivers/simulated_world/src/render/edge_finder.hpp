// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace panvo::simulated_world {

inline constexpr std::uint32_t kSunny = 0x80000000u;  ///< the top bit of a normal: the surface is sunlit

/// The surfaces at the pixel centres.
struct SeenSurfaces {
  const cv::Mat& radiance;       ///< CV_32FC3
  const cv::Mat& inverse_range;  ///< CV_32FC1, 1/m; 0: the sky
  const cv::Mat& key;            ///< CV_32SC1, object and material
  const cv::Mat& normal;         ///< CV_32SC1: x, y, z as signed bytes, then material flags and, on top, sunshine
  bool wraps = false;
};

/// The result of find_edges() for a pixel.
enum EdgeMark : std::uint8_t {
  kCrossed = 1,      ///< an edge may cross it
  kInLeaves = 2,     ///< it lies among leaves, where single edges are not visible
  kAllInSun = 4,     ///< it and its neighbours, except for sky, are sunlit
  kAllInShadow = 8,  ///< it and its neighbours, except for sky, are in shadow
};

/// Marks (0, or bits of EdgeMark) the pixels in these rows that an edge may cross: a neighbour differs in object,
/// direction, range or sunlight, and also in radiance.
void find_edges(const SeenSurfaces& seen, int first_row, int end_row, cv::Mat& is_edge);

}  // namespace panvo::simulated_world

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace panvo::simulation {

inline constexpr std::uint32_t kSunny = 0x80000000u;  ///< the top bit of a normal: it is in the sun

/// What the centres of the pixels see.
struct SeenSurfaces {
  const cv::Mat& radiance;       ///< CV_32FC3
  const cv::Mat& inverse_range;  ///< CV_32FC1, 1/m; 0: the sky
  const cv::Mat& key;            ///< CV_32SC1, object and material
  const cv::Mat& normal;         ///< CV_32SC1: x, y, z as signed bytes, then material flags and, on top, sunshine
  bool wraps = false;
};

/// What find_edges() tells of a pixel.
enum EdgeMark : std::uint8_t {
  kCrossed = 1,      ///< an edge may cross it
  kInLeaves = 2,     ///< it lies among leaves, where nobody sees a single edge
  kAllInSun = 4,     ///< it and its neighbours, as far as they are not sky, are in the sun
  kAllInShadow = 8,  ///< none of them is
};

/// Marks (0, or EdgeMark's bits) the pixels in these rows that an edge may cross: a neighbour belongs to something else, faces
/// elsewhere, lies behind or before, or in other light, and looks different, too.
void find_edges(const SeenSurfaces& seen, int first_row, int end_row, cv::Mat& is_edge);

}  // namespace panvo::simulation

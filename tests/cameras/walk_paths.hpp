// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "process.hpp"

namespace panvo::test {

/// Position on a path, m.
struct Position {
  double x, y, z;
};

inline std::vector<Position> read_tum(const std::string& file) {
  std::vector<Position> positions;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string stamp;
    Position position{};
    if (words >> stamp >> position.x >> position.y >> position.z) positions.push_back(position);
  }
  return positions;
}

inline double distance(const Position& a, const Position& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Distance of a point from the nearest point of a path, m.
inline double distance(const Position& point, const std::vector<Position>& path) {
  double nearest_m = 1e9;
  for (const auto& other : path) nearest_m = std::min(nearest_m, distance(point, other));
  return nearest_m;
}

/// Largest distance of a point of `points` from a path, m.
inline double max_distance(const std::vector<Position>& points, const std::vector<Position>& path) {
  double max_m = 0.0;
  for (const auto& point : points) max_m = std::max(max_m, distance(point, path));
  return max_m;
}

/// Writes the camera of the rendered walk as a camera_info file; `tx` is the last value in the first row of the
/// projection matrix.
inline void write_calibration(const std::string& file, double tx) {
  std::ofstream(file) << "image_width: 320\nimage_height: 240\ncamera_name: rendered\n"
                         "camera_matrix: {rows: 3, cols: 3, data: [240, 0, 160, 0, 240, 120, 0, 0, 1]}\n"
                         "distortion_model: plumb_bob\n"
                         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
                         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
                         "projection_matrix: {rows: 3, cols: 4, data: [240, 0, 160, "
                      << tx << ", 0, 240, 120, 0, 0, 0, 1, 0]}\n";
}

}  // namespace panvo::test

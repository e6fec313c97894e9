// SPDX-License-Identifier: Apache-2.0
#include "road_line.hpp"

#include <algorithm>

namespace panvo::simulated_world {

RoadLine::RoadLine(const std::vector<Eigen::Vector2d>& points) : points_(points) {
  along_m_.push_back(0.0);
  for (std::size_t i = 1; i < points.size(); ++i)
    along_m_.push_back(along_m_.back() + (points[i] - points[i - 1]).norm());
}

std::size_t RoadLine::piece(double along_m) const {
  const auto next = std::upper_bound(along_m_.begin() + 1, along_m_.end() - 1, along_m);
  return static_cast<std::size_t>(next - along_m_.begin()) - 1;
}

Eigen::Vector2d RoadLine::point(double along_m) const {
  const std::size_t i = piece(along_m);
  return points_[i] + (along_m - along_m_[i]) * (points_[i + 1] - points_[i]).normalized();
}

Eigen::Vector2d RoadLine::forward(double along_m) const {
  constexpr double kReach_m = 0.6;
  return (point(along_m + kReach_m) - point(along_m - kReach_m)).normalized();
}

Eigen::Vector2d RoadLine::beside(double along_m, double left_m) const {
  const Eigen::Vector2d way = forward(along_m);
  return point(along_m) + left_m * Eigen::Vector2d(-way.y(), way.x());
}

}  // namespace panvo::simulated_world

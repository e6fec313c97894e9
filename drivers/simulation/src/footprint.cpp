// SPDX-License-Identifier: Apache-2.0
#include "footprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace panvo::simulation {

namespace {

using Eigen::Vector2d;

Vector2d axis(const Footprint& box) { return {std::cos(box.heading_rad), std::sin(box.heading_rad)}; }

std::array<Vector2d, 4> corners(const Footprint& box) {
  const Vector2d along = 0.5 * box.length_m * axis(box);
  const Vector2d across = 0.5 * box.width_m * Vector2d(-axis(box).y(), axis(box).x());
  return {Vector2d(box.centre + along + across), Vector2d(box.centre - along + across),
          Vector2d(box.centre - along - across), Vector2d(box.centre + along - across)};
}

// Largest distance of the other's corners beyond the front, rear or sides of this box: positive if one of its edges
// separates both.
double gap(const Footprint& box, const std::array<Vector2d, 4>& others) {
  const Vector2d along = axis(box), across(-along.y(), along.x());
  double widest = -std::numeric_limits<double>::infinity();
  for (const auto& [direction, half] : {std::pair{along, 0.5 * box.length_m}, std::pair{across, 0.5 * box.width_m}}) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vector2d& corner : others) {
      const double at = direction.dot(corner - box.centre);
      least = std::min(least, at);
      most = std::max(most, at);
    }
    widest = std::max({widest, least - half, -most - half});
  }
  return widest;
}

double distance_to_box(const Footprint& box, const Vector2d& point) {
  const Vector2d along = axis(box), across(-along.y(), along.x()), from = point - box.centre;
  return Vector2d(std::max(0.0, std::abs(along.dot(from)) - 0.5 * box.length_m),
                  std::max(0.0, std::abs(across.dot(from)) - 0.5 * box.width_m))
      .norm();
}

}  // namespace

double distance(const Footprint& a, const Footprint& b) {
  const auto of_a = corners(a), of_b = corners(b);
  if (std::max(gap(a, of_b), gap(b, of_a)) <= 0.0) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    nearest = std::min({nearest, distance_to_box(a, of_b[i]), distance_to_box(b, of_a[i])});
  }
  return nearest;
}

}  // namespace panvo::simulation

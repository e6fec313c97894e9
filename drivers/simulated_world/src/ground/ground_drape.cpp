// SPDX-License-Identifier: Apache-2.0
#include "ground_drape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace panvo::simulated_world {

std::uint32_t Drape::vertex(const Eigen::Vector2d& point, const Cloth& cloth) {
  const Eigen::Vector2d offset = point - cloth.origin;
  Vertex vertex;
  vertex.position = Eigen::Vector3d(point.x(), point.y(), site_.terrain.height_m(point) + cloth.lift_m).cast<float>();
  vertex.normal = site_.terrain.normal(point).cast<float>();
  vertex.uv =
      Eigen::Vector2d(offset.dot(cloth.forward), cloth.forward.x() * offset.y() - cloth.forward.y() * offset.x())
          .cast<float>();
  vertex.tint = paint_.laid(point, cloth.tint, cloth.contrast);
  mesh_.vertices.push_back(vertex);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void Drape::ribbon(std::span<const Eigen::Vector2d> right, std::span<const Eigen::Vector2d> left, const Cloth& cloth) {
  std::uint32_t last_right = 0, last_left = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const std::uint32_t now_right = vertex(right[i], cloth), now_left = vertex(left[i], cloth);
    if (i > 0) {
      mesh_.triangles.push_back({{last_right, now_right, now_left}, cloth.material});
      mesh_.triangles.push_back({{last_right, now_left, last_left}, cloth.material});
    }
    last_right = now_right;
    last_left = now_left;
  }
}

void Drape::polygon(std::span<const Eigen::Vector2d> outline, const Cloth& cloth) {
  const std::uint32_t first = vertex(outline[0], cloth);
  std::uint32_t last = vertex(outline[1], cloth);
  for (std::size_t i = 2; i < outline.size(); ++i) {
    const std::uint32_t now = vertex(outline[i], cloth);
    mesh_.triangles.push_back({{first, last, now}, cloth.material});
    last = now;
  }
}

void Drape::rectangle(const Rectangle& where, const Cloth& cloth) {
  const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * where.half_length_m)));
  std::vector<Eigen::Vector2d> right, left;
  for (int i = 0; i <= steps; ++i) {
    const double forward_m = where.half_length_m * (2.0 * i / steps - 1.0);
    right.push_back(where.at(forward_m, -where.half_width_m));
    left.push_back(where.at(forward_m, where.half_width_m));
  }
  ribbon(right, left, cloth);
}

void Drape::disc(const Eigen::Vector2d& middle, double radius_m, int sides, const Cloth& cloth) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    outline.emplace_back(middle + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  polygon(outline, cloth);
}

void Drape::ragged(const Rectangle& where, double ragged_m, const Cloth& cloth, Random random) {
  const int steps = std::max(3, static_cast<int>(std::ceil(2.0 * where.half_length_m / 0.45)));
  std::vector<Eigen::Vector2d> right, left;
  // cut straight with broken edges: skewed as a whole, ragged from step to step
  const double skew_m = random.uniform(-0.12, 0.12) * where.half_width_m;
  const double taper = random.uniform(-0.06, 0.06);
  for (int i = 0; i <= steps; ++i) {
    const double share = 2.0 * i / steps - 1.0;
    const bool is_end = i == 0 || i == steps;
    const double half_width_m = where.half_width_m * (1.0 + taper * share);
    const auto side = [&](double sign) {
      const double forward_m =
          where.half_length_m * share + (is_end ? sign * skew_m + random.uniform(-ragged_m, ragged_m) : 0.0);
      return where.at(forward_m,
                      sign * (half_width_m + random.uniform(-ragged_m, ragged_m) - (is_end ? ragged_m : 0.0)));
    };
    right.push_back(side(-1.0));
    left.push_back(side(1.0));
  }
  ribbon(right, left, cloth);
}

void Drape::thread(const std::vector<Eigen::Vector2d>& line, double width_m, const Cloth& cloth, Random random) {
  if (line.size() < 2) return;
  std::vector<Eigen::Vector2d> right, left;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2d way = (line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
    const bool is_end = i == 0 || i + 1 == line.size();
    const double half_m = (is_end ? 0.15 : random.uniform(0.3, 0.5)) * width_m;
    const Eigen::Vector2d aside(-way.y(), way.x());
    right.push_back(line[i] - half_m * aside);
    left.push_back(line[i] + half_m * aside);
  }
  ribbon(right, left, cloth);
}

}  // namespace panvo::simulated_world

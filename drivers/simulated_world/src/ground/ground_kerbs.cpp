// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "../kerb_field.hpp"
#include "ground_parts.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {
namespace {

// Points on a closed line at equal distances of about `step_m`.
std::vector<Eigen::Vector2d> evenly(const std::vector<Eigen::Vector2d>& line, double step_m) {
  std::vector<double> along{0.0};
  for (std::size_t i = 0; i < line.size(); ++i)
    along.push_back(along.back() + (line[(i + 1) % line.size()] - line[i]).norm());
  const auto count = std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(along.back() / step_m)));
  std::vector<Eigen::Vector2d> places;
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = along.back() * static_cast<double>(k) / static_cast<double>(count);
    while (i + 2 < along.size() && along[i + 1] <= at) ++i;
    const double share = along[i + 1] > along[i] ? (at - along[i]) / (along[i + 1] - along[i]) : 0.0;
    places.emplace_back(line[i] + share * (line[(i + 1) % line.size()] - line[i]));
  }
  return places;
}

// A stone's profile across the kerb, from the road side over the top: {outwards, up} m.
constexpr std::array<std::array<double, 2>, 4> kProfile{
    {{0.0, -0.03}, {0.008, 0.097}, {0.03, 0.124}, {kKerbStoneWidth_m + 0.01, 0.126}}};

}  // namespace

Mesh kerb_stones(const Site& site, const GroundPaint& paint) {
  Mesh mesh;
  const std::uint16_t kerb = site.palette->find("kerb");
  Random random(site.parameters.seed, "kerb stones");
  for (const std::vector<Eigen::Vector2d>& line : site.kerbs->kerb_lines()) {
    // half stones; two form a whole one where the kerb is straight
    const std::vector<Eigen::Vector2d> places = evenly(line, 0.5);
    const std::size_t count = places.size();
    double along_m = 0.0;
    for (std::size_t i = 0; i < count;) {
      const Eigen::Vector2d &start = places[i], &next = places[(i + 1) % count], &over = places[(i + 2) % count];
      const bool is_straight = i + 2 <= count && (0.5 * (start + over) - next).norm() < 0.004;
      const Eigen::Vector2d& end = is_straight ? over : next;
      i += is_straight ? 2 : 1;
      // slightly misaligned
      const double sunk_m = random.uniform(-0.003, 0.002), out_m = random.uniform(-0.004, 0.004);
      const float shade = static_cast<float>(random.uniform(0.78, 1.0));
      const float length_m = static_cast<float>((end - start).norm());
      for (std::size_t k = 0; k + 1 < kProfile.size(); ++k) {
        const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
        const Eigen::Vector2d across(kProfile[k + 1][0] - kProfile[k][0], kProfile[k + 1][1] - kProfile[k][1]);
        for (int corner = 0; corner < 4; ++corner) {
          const bool is_end = corner == 1 || corner == 2, is_upper = corner >= 2;
          const auto& profile = kProfile[k + (is_upper ? 1 : 0)];
          const Eigen::Vector2d& foot = is_end ? end : start;
          const Eigen::Vector2d out = site.kerbs->outwards(foot);
          const Eigen::Vector2d point = foot + (profile[0] + out_m) * out;
          const Eigen::Vector3d normal =
              (Eigen::Vector3d(0.0, 0.0, across.x()) - across.y() * Eigen::Vector3d(out.x(), out.y(), 0.0))
                  .normalized();
          // darker at the base, where water collects
          const float dirt = profile[1] < 0.0 ? 0.62f : 1.0f;
          Vertex vertex;
          vertex.position =
              Eigen::Vector3d(point.x(), point.y(), site.terrain.height_m(foot) + profile[1] + sunk_m).cast<float>();
          vertex.normal = normal.cast<float>();
          vertex.uv = {static_cast<float>(along_m) + (is_end ? length_m : 0.0f),
                       static_cast<float>(profile[0] + profile[1])};
          vertex.tint = paint.laid(point, dirt * shade * Eigen::Vector3f(1.0f, 0.99f, 0.97f));
          mesh.vertices.push_back(vertex);
        }
        // the road is on the left of the line, outwards on the right
        mesh.triangles.push_back({{base, base + 2, base + 1}, kerb});
        mesh.triangles.push_back({{base, base + 3, base + 2}, kerb});
      }
      along_m += length_m;
    }
  }
  return mesh;
}

}  // namespace panvo::simulated_world

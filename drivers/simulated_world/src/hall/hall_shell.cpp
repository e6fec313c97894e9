// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "../kerb_field.hpp"
#include "../shapes.hpp"
#include "hall_parts.hpp"

namespace panvo::simulated_world {
namespace {

using Eigen::Vector3f;

constexpr float kTile_m = 6.0f;  // of floor and roof: light is baked at their corners
constexpr float kPillarSpacing_m = 12.0f;
constexpr float kLampDrop_m = 1.2f;  // below the roof
constexpr double kLampSpacing_m = 10.0;

Vector3f at_height(const Eigen::Vector2d& point, float height_m) {
  return {static_cast<float>(point.x()), static_cast<float>(point.y()), height_m};
}

/// Calls `visit` with every multiple of `step` between two numbers.
template <typename Visit>
void for_multiples(float step, float from, float to, Visit&& visit) {
  for (float value = step * std::ceil(from / step); value < to; value += step) visit(value);
}

class Shell {
 public:
  Shell(const Site& site, const HallArea& area, Scene& scene)
      : site_(site), area_(area), scene_(scene), random_(site.parameters.seed, "hall shell") {}

  void lay_floor() {
    Mesh floor;
    add_plane(floor, 0.0f, true, material("concrete"), grey(0.8f));
    add_joints(floor);
    add_stains(floor);
    add_lane_lines(floor);
    scene_.fixed.push_back(std::move(floor));
  }

  void raise_walls() {
    Mesh walls;
    const auto panels = material("concrete_panels"), gate = material("metal_sheet");
    const Eigen::Vector2f& low = area_.low;
    const Eigen::Vector2f& high = area_.high;
    const std::array<Eigen::Vector2f, 5> corners{low, {low.x(), high.y()}, high, {high.x(), low.y()}, low};
    for (std::size_t side = 0; side < 4; ++side) {
      const float length = (corners[side + 1] - corners[side]).norm();
      const Eigen::Vector2f along = (corners[side + 1] - corners[side]) / length;
      Random random = random_.part(2).part(side);
      for (float from = 0.0f; from < length; from += kTile_m) {
        const auto at = [&](float distance, float height) {
          const Eigen::Vector2f foot = corners[side] + std::min(distance, length) * along;
          return Vector3f(foot.x(), foot.y(), height);
        };
        const bool is_gate = random.chance(0.15);
        walls.add_quad(at(from, 0.0f), at(from + kTile_m, 0.0f), at(from + kTile_m, kHallHeight_m),
                       at(from, kHallHeight_m), is_gate ? gate : panels, {from, 0.0f}, grey(is_gate ? 0.6f : 0.85f));
      }
    }
    scene_.fixed.push_back(std::move(walls));
  }

  void set_pillars(const std::vector<PlannedPlot>& plots) {
    constexpr float kHalf_m = 0.25f, kGuard_m = 1.1f;
    constexpr double kFree_m = 0.6;  // from the aisle, to a pillar's middle
    Mesh pillars;
    const auto concrete = material("concrete"), paint = material("metal_painted");
    for_multiples(kPillarSpacing_m, area_.low.x(), area_.high.x(), [&](float x) {
      for_multiples(kPillarSpacing_m, area_.low.y(), area_.high.y(), [&](float y) {
        const Eigen::Vector2d point(x, y);
        if (site_.distance_from_kerb(point) < kFree_m) return;
        if (std::ranges::any_of(plots, [&](const auto& planned) { return planned.plot.contains(point, kHalf_m); }))
          return;
        const Vector3f corner(x - kHalf_m, y - kHalf_m, 0.0f);
        add_block(pillars, corner, corner + Vector3f(2 * kHalf_m, 2 * kHalf_m, kHallHeight_m), concrete, grey(0.95f));
        for (int stripe = 0; stripe < 4; ++stripe) {  // a guard, yellow and black
          const Tint tint = stripe % 2 == 0 ? tint_of(0.95f, 0.7f, 0.05f) : grey(0.05f);
          const float low = kGuard_m * static_cast<float>(stripe) / 4.0f;
          add_block(pillars, corner + Vector3f(-0.03f, -0.03f, low),
                    corner + Vector3f(2 * kHalf_m + 0.03f, 2 * kHalf_m + 0.03f, low + kGuard_m / 4.0f), paint, tint);
        }
      });
    });
    scene_.fixed.push_back(std::move(pillars));
  }

  /// The roof casts no shadow: with it, no ambient light would reach the floor.
  void add_roof() {
    constexpr float kBeam_m = 0.18f, kMainBeam_m = 0.6f;
    Mesh roof;
    add_plane(roof, kHallHeight_m, false, material("metal_sheet"), grey(0.8f));
    const auto steel = material("metal_painted");
    for_multiples(kTile_m, area_.low.x(), area_.high.x(), [&](float x) {
      add_block(roof, {x - 0.06f, area_.low.y(), kHallHeight_m - kBeam_m}, {x + 0.06f, area_.high.y(), kHallHeight_m},
                steel, grey(0.75f));
    });
    for_multiples(kPillarSpacing_m, area_.low.y(), area_.high.y(), [&](float y) {
      add_block(roof, {area_.low.x(), y - 0.15f, kHallHeight_m - kMainBeam_m},
                {area_.high.x(), y + 0.15f, kHallHeight_m}, steel, grey(0.65f));
    });
    hang(std::move(roof));
  }

  /// Lamps above the middle of the aisles, all alike.
  void hang_lamps() {
    constexpr float kIntensity = 7.0f;
    Mesh lamps;
    const auto lit = material("lamp_head"), steel = material("metal_painted");
    for (int road = 0; road < static_cast<int>(site_.roads.roads.size()); ++road) {
      const double length = length_of(site_.roads.roads[static_cast<std::size_t>(road)]);
      for (double along = 0.5 * kLampSpacing_m; along < length; along += kLampSpacing_m) {
        const Roadside place = roadside(site_.roads, road, along, true);
        const Vector3f middle = at_height(place.middle, kHallHeight_m - kLampDrop_m);
        const Vector3f half = 0.75f * at_height(place.along, 0.0f);
        add_tube(lamps, middle - half, middle + half, 0.05f, 0.05f, 8, lit, grey(1.0f), true);
        for (const float end : {-1.0f, 1.0f}) {
          const Vector3f foot = middle + end * half;
          add_tube(lamps, foot, foot + kLampDrop_m * Vector3f::UnitZ(), 0.01f, 0.01f, 4, steel, grey(0.4f));
        }
        scene_.lamps.push_back({middle, kIntensity, true});
      }
    }
    hang(std::move(lamps));
  }

 private:
  std::uint16_t material(std::string_view name) const { return site_.palette->find(name); }

  void hang(Mesh mesh) {
    scene_.models.push_back(std::move(mesh));
    Placement placement;
    placement.model = static_cast<std::uint32_t>(scene_.models.size() - 1);
    placement.visibility = kToStereo | kToPanorama;
    scene_.standing.push_back(placement);
  }

  /// The whole area at that height, in tiles.
  void add_plane(Mesh& mesh, float height_m, bool faces_up, std::uint16_t of, Tint tint) const {
    const Eigen::Vector2f size = area_.high - area_.low;
    const int columns = static_cast<int>(std::ceil(size.x() / kTile_m)) + 1,
              rows = static_cast<int>(std::ceil(size.y() / kTile_m)) + 1;
    std::vector<Vector3f> grid;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const float y = std::min(area_.low.y() + kTile_m * static_cast<float>(row), area_.high.y());
        const float x = std::min(area_.low.x() + kTile_m * static_cast<float>(column), area_.high.x());
        grid.emplace_back(faces_up ? x : area_.low.x() + area_.high.x() - x, y, height_m);
      }
    }
    add_surface(
        mesh, grid, columns, [&](int, int) { return of; }, tint);
  }

  void add_joints(Mesh& floor) const {
    constexpr float kHalf_m = 0.012f, kAbove_m = 0.003f;
    const auto joint = material("asphalt_smooth");
    for_multiples(kTile_m, area_.low.x(), area_.high.x(), [&](float x) {
      floor.add_quad({x - kHalf_m, area_.low.y(), kAbove_m}, {x + kHalf_m, area_.low.y(), kAbove_m},
                     {x + kHalf_m, area_.high.y(), kAbove_m}, {x - kHalf_m, area_.high.y(), kAbove_m}, joint, {0, 0},
                     grey(0.5f));
    });
    for_multiples(kTile_m, area_.low.y(), area_.high.y(), [&](float y) {
      floor.add_quad({area_.low.x(), y - kHalf_m, kAbove_m}, {area_.high.x(), y - kHalf_m, kAbove_m},
                     {area_.high.x(), y + kHalf_m, kAbove_m}, {area_.low.x(), y + kHalf_m, kAbove_m}, joint, {0, 0},
                     grey(0.5f));
    });
  }

  /// Oil and repairs, where the vehicles drive.
  void add_stains(Mesh& floor) const {
    constexpr int kCorners = 9;
    const auto stain = material("concrete");
    for (std::size_t road = 0; road < site_.roads.roads.size(); ++road) {
      Random random = random_.part(1).part(road);
      const double length = length_of(site_.roads.roads[road]);
      for (double along = 0.0; along < length; along += random.uniform(0.5, 5.0)) {
        const Roadside place = roadside(site_.roads, static_cast<int>(road), along, random.chance(0.5));
        const Vector3f middle =
            at_height(place.middle + random.uniform(0.0, 1.1) * place.kerb_m * place.outwards, 0.002f);
        const float dark = between(random, 0.35, 0.9), size = between(random, 0.08, 0.5);
        std::vector<Vertex> corners;
        for (int i = 0; i < kCorners; ++i) {
          const float angle = 2.0f * kPi * static_cast<float>(i) / kCorners, radius = size * between(random, 0.5, 1.2);
          const Vector3f position = middle + radius * Vector3f(std::cos(angle), std::sin(angle), 0.0f);
          corners.push_back({position, Vector3f::UnitZ(), position.head<2>(), grey(dark)});
        }
        floor.add_polygon(corners, stain);
      }
    }
  }

  void add_lane_lines(Mesh& floor) const {
    constexpr double kHalf_m = 0.05, kInside_m = 0.2, kShortest_m = 1e-3;
    constexpr float kAbove_m = 0.004f;
    const auto paint = material("marking");
    for (const auto& line : site_.kerbs->kerb_lines()) {
      for (std::size_t i = 0; i < line.size(); ++i) {
        const Eigen::Vector2d &a = line[i], &b = line[(i + 1) % line.size()];
        if ((b - a).norm() < kShortest_m) continue;
        const Eigen::Vector2d inwards_a = -site_.kerbs->outwards(a), inwards_b = -site_.kerbs->outwards(b);
        floor.add_quad(at_height(a + (kInside_m - kHalf_m) * inwards_a, kAbove_m),
                       at_height(b + (kInside_m - kHalf_m) * inwards_b, kAbove_m),
                       at_height(b + (kInside_m + kHalf_m) * inwards_b, kAbove_m),
                       at_height(a + (kInside_m + kHalf_m) * inwards_a, kAbove_m), paint, {0, 0},
                       tint_of(0.95f, 0.75f, 0.1f));
      }
    }
  }

  const Site& site_;
  HallArea area_;
  Scene& scene_;
  Random random_;
};

}  // namespace

void build_hall_shell(const Site& site, const HallArea& area, const std::vector<PlannedPlot>& plots, Scene& scene) {
  Shell shell(site, area, scene);
  shell.lay_floor();
  shell.raise_walls();
  shell.set_pillars(plots);
  shell.add_roof();
  shell.hang_lamps();
}

}  // namespace panvo::simulated_world

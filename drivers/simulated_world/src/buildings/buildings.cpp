// SPDX-License-Identifier: Apache-2.0
#include "buildings.hpp"

#include <algorithm>
#include <cmath>

#include "../plots.hpp"
#include "../shapes.hpp"

namespace panvo::simulated_world {
namespace {

BuildingUse building_use(PlotUse use) {
  switch (use) {
    case PlotUse::kHouse:
      return BuildingUse::kHouse;
    case PlotUse::kInstitute:
      return BuildingUse::kInstitute;
    case PlotUse::kHall:
      return BuildingUse::kHall;
    default:
      return BuildingUse::kTown;
  }
}

/// Makes walls plain, for junctions with weak texture.
void make_plain(FacadeStyle& style, double weakness) {
  style.contrast = static_cast<float>(1.0 - weakness);
  if (weakness < 0.3) return;
  style.ledges = style.surrounds = style.quoins = style.shutters = style.balconies = style.dentils = style.ivy =
      style.two_tone = false;
  style.pediments = style.keystones = style.shopfronts = style.pilasters = style.lintels = false;
  style.ground_wall = style.wall;
  style.bay *= 1.8f;
  style.grime = 0.1f;
}

/// Lowest and highest ground (m) of a plot: the walls reach below the lowest, the floor lies on the highest.
std::pair<float, float> ground_range(const Site& site, const Plot& plot) {
  double low = 1e9, high = -1e9;
  for (const auto& probe : probes_of(plot)) {
    const double ground = site.ground_m(probe);
    low = std::min(low, ground);
    high = std::max(high, ground);
  }
  return {static_cast<float>(low), static_cast<float>(high)};
}

/// A body on a part of the plot; `x`, `y`: its centre in the plot's frame.
Body body_on(const Site& site, const Plot& plot, float x, float y, float width, float depth) {
  const auto [low, high] = ground_range(site, plot);
  Body body;
  const auto heading = static_cast<float>(plot.heading_rad);
  body.world_from_body.linear() = Eigen::AngleAxisf(heading, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  const Eigen::Vector3f centre(static_cast<float>(plot.centre.x()), static_cast<float>(plot.centre.y()), high);
  body.world_from_body.translation() = centre + body.world_from_body.linear() * Eigen::Vector3f(x, y, 0.0f);
  body.width = width;
  body.depth = depth;
  body.depth_below = high - low + 0.4f;
  return body;
}

void build_on(const Site& site, const PlannedPlot& planned, const FacadeStyle& style,
              const BuildingMaterials& materials, Random random, Mesh& mesh) {
  const auto width = static_cast<float>(planned.plot.size.x()), depth = static_cast<float>(planned.plot.size.y());
  const auto add = [&](const FacadeStyle& own, float x, float y, float own_width, float own_depth, bool across,
                       std::uint64_t part) {
    Body body = body_on(site, planned.plot, x, y, own_width, own_depth);
    body.ridge_across = across;
    build_body(own, materials, body, random.part(part), mesh);
  };
  const double shape = random.uniform();
  const bool is_big = planned.use == PlotUse::kInstitute;
  if (width < 11.0f || planned.use == PlotUse::kHall || shape < 0.45) {
    add(style, 0.0f, 0.0f, width, depth, planned.use == PlotUse::kHouse && width < 12.0f && random.chance(0.4), 1);
  } else if (shape < 0.75) {  // a recessed wing, one floor lower
    FacadeStyle wing = style;
    wing.floors = std::max(1, style.floors - 1);
    const float share = static_cast<float>(random.uniform(0.3, 0.45));
    const float side = random.chance(0.5) ? 1.0f : -1.0f;
    const float back = is_big ? 3.0f : 1.5f;
    add(style, -side * 0.5f * share * width, 0.0f, (1.0f - share) * width, depth, false, 1);
    add(wing, side * 0.5f * (1.0f - share) * width, 0.5f * back, share * width, depth - back, false, 2);
  } else {  // a protruding centre with a gable to the road
    const float forward = is_big ? 2.0f : 1.2f;
    const float middle = std::clamp(style.bay * (is_big ? 4.0f : 3.0f), 5.0f, 0.6f * width);
    FacadeStyle centre = style;
    if (is_big) ++centre.floors;
    FacadeStyle sides = style;
    sides.shopfronts = false;
    add(sides, 0.0f, 0.5f * forward, width, depth - forward, false, 1);
    const float deep = is_big ? depth : 0.55f * depth;
    add(centre, 0.0f, -0.5f * (depth - deep), middle, deep, style.roof != RoofKind::kHip, 2);
  }
}

}  // namespace

WallFrame Body::wall(int side) const {
  const Eigen::Vector3f x = world_from_body.linear().col(0), y = world_from_body.linear().col(1);
  const Eigen::Vector3f outwards[] = {-y, x, y, -x};
  const Eigen::Vector3f right[] = {x, y, -x, -y};
  const bool is_along = side % 2 == 0;
  WallFrame frame;
  frame.outwards = outwards[side];
  frame.right = right[side];
  frame.width = is_along ? width : depth;
  frame.depth_below = depth_below;
  frame.origin = world_from_body.translation() + 0.5f * (is_along ? depth : width) * frame.outwards -
                 0.5f * frame.width * frame.right;
  return frame;
}

void build_body(const FacadeStyle& style, const BuildingMaterials& materials, const Body& body, Random lights,
                Mesh& mesh) {
  constexpr FacadeSide kSides[] = {FacadeSide::kFront, FacadeSide::kSide, FacadeSide::kBack, FacadeSide::kSide};
  for (int side = 0; side < 4; ++side) {
    build_facade(style, materials, body.wall(side), kSides[side], lights.part(static_cast<std::uint64_t>(side)), mesh);
  }
  build_roof(style, materials, body, lights.part(9), mesh);
}

std::vector<Plot> build_buildings(const Site& site, Scene& scene) {
  const BuildingMaterials materials(*site.palette);
  const Random random(site.parameters.seed, "buildings");
  const bool in_rows = site.parameters.layout == Layout::kRows;
  std::vector<Plot> plots;
  std::uint64_t number = 0, style_number = 0;
  PlotUse last_use = PlotUse::kOpen;
  for (const auto& planned : plan_plots(site)) {
    ++number;
    if (planned.use == PlotUse::kOpen) continue;  // left to build_furniture()
    const std::uint64_t design = in_rows ? static_cast<std::uint64_t>(planned.use) : planned.design.value_or(number);
    Random own = random.part(design);
    // sometimes a twin of the neighbour
    const bool is_twin = !in_rows && !planned.design && planned.use == last_use && own.chance(0.22);
    if (!is_twin) style_number = design;
    last_use = planned.use;
    FacadeStyle style =
        draw_style(building_use(planned.use), *site.palette, materials, random.part(style_number).part(7));
    const double weakness = site.weakness(planned.place.at(0.0));
    if (weakness > 0.0) make_plain(style, weakness);
    Mesh mesh;
    build_on(site, planned, style, materials, own.part(3), mesh);
    scene.fixed.push_back(std::move(mesh));
    plots.push_back(planned.plot);
  }
  return plots;
}

}  // namespace panvo::simulated_world

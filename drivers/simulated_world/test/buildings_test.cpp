// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "../src/buildings/facade.hpp"
#include "../src/plots.hpp"
#include "town.hpp"

namespace panvo::simulated_world {
namespace {

Plot plot_at(double x, double y, double width_m, double depth_m, double heading_rad) {
  return {{x, y}, heading_rad, {width_m, depth_m}};
}

TEST(Plots, ContainWhatLiesInTheirTurnedRectangle) {
  const Plot plot = plot_at(10.0, 20.0, 8.0, 4.0, std::numbers::pi / 2.0);  // 8 m along y, 4 m along x
  EXPECT_TRUE(plot.contains({10.0, 23.9}, 0.0));
  EXPECT_FALSE(plot.contains({13.9, 20.0}, 0.0));
  EXPECT_TRUE(plot.contains({12.5, 20.0}, 0.6));
  EXPECT_FALSE(plot.contains({12.5, 20.0}, 0.4));
}

TEST(Plots, OverlapExactlyWhenNoSideSeparatesThem) {
  const Plot plot = plot_at(0, 0, 10, 10, 0.0);
  EXPECT_TRUE(overlap(plot, plot_at(9.9, 0, 10, 10, 0.0), 0.0));
  EXPECT_FALSE(overlap(plot, plot_at(10.1, 0, 10, 10, 0.0), 0.0));
  EXPECT_TRUE(overlap(plot, plot_at(10.1, 0, 10, 10, 0.0), 0.2));
  // a rotated square extends 5 sqrt(2) along x
  EXPECT_TRUE(overlap(plot, plot_at(12.0, 0, 10, 10, std::numbers::pi / 4.0), 0.0));
  EXPECT_FALSE(overlap(plot, plot_at(12.1, 0, 10, 10, std::numbers::pi / 4.0), 0.0));
}

TEST(Buildings, OfOneUseAreAlikeInRows) {
  Site site = crossroads();
  site.parameters.layout = Layout::kRows;
  std::map<PlotUse, std::set<double>> widths;
  std::map<PlotUse, std::set<std::size_t>> corners;
  std::vector<PlannedPlot> built;
  for (const auto& planned : plan_plots(site)) {
    widths[planned.use].insert(planned.plot.size.x());
    if (planned.use != PlotUse::kOpen) built.push_back(planned);
  }
  Scene scene;
  scene.palette = site.palette;
  build_buildings(site, scene);
  ASSERT_EQ(scene.fixed.size(), built.size());
  ASSERT_GE(built.size(), 12u);
  for (std::size_t i = 0; i < built.size(); ++i) corners[built[i].use].insert(scene.fixed[i].vertices.size());
  for (const auto& [use, of_use] : widths) EXPECT_EQ(of_use.size(), 1u) << static_cast<int>(use);
  for (const auto& [use, of_use] : corners) EXPECT_EQ(of_use.size(), 1u) << static_cast<int>(use);
}

/// How many of the plots around the western and eastern end of the crossroads have a twin a quarter turn further, of all
/// of them; the buildings of twins must be equal.
std::pair<int, int> twins_at_ends(const Site& site) {
  Scene scene;
  scene.palette = site.palette;
  const auto plots = build_buildings(site, scene);
  int twins = 0, all = 0;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    if (std::abs(plots[i].centre.x()) < 75.0) continue;
    const Eigen::Vector2d turned(-plots[i].centre.y(), plots[i].centre.x());
    ++all;
    for (std::size_t j = 0; j < plots.size(); ++j) {
      // the roads differ in width
      if ((turned - plots[j].centre).norm() > 3.0 || plots[i].size != plots[j].size) continue;
      ++twins;
      EXPECT_EQ(scene.fixed[i].vertices.size(), scene.fixed[j].vertices.size());
    }
  }
  return {twins, all};
}

TEST(Buildings, AreTheSameAtTwinJunctions) {
  Site site = crossroads();
  EXPECT_EQ(twins_at_ends(site).first, 0);
  site.parameters.layout = Layout::kTwins;
  const auto [twins, all] = twins_at_ends(site);
  EXPECT_GE(all, 4);
  EXPECT_GE(twins, 0.8 * all);  // some are shifted further
}

TEST(Buildings, OfCampusJunctionsHaveTwinsAtOneOtherJunction) {
  const auto roads = campus_roads(1);
  SiteParameters parameters;
  parameters.layout = Layout::kTwins;
  const Site site(parameters, roads, crossroads().palette);
  std::map<std::uint64_t, int> count;
  for (const auto& planned : plan_plots(site)) ++count[planned.design.value()];
  int twins = 0;
  for (const auto& [design, number] : count) {
    EXPECT_LE(number, 2) << design;
    if (number == 2) twins += 2;
  }
  EXPECT_GT(twins, 0.75 * static_cast<double>(plan_plots(site).size()));
}

TEST(Plots, ArePlannedAlongRoadsButNeitherOnThemNorOnEachOther) {
  const Site site = crossroads();
  const auto planned = plan_plots(site);
  ASSERT_GE(planned.size(), 12u);
  for (std::size_t i = 0; i < planned.size(); ++i) {
    for (const auto& probe : probes_of(planned[i].plot)) EXPECT_GT(site.distance_from_kerb(probe), kPavementWidth_m);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(planned[i].plot, planned[j].plot, 2.9));
  }
}

TEST(Roadsides, LieAsFarFromTheKerbAsAskedFor) {
  const Site site = crossroads();
  const Roadside place = roadside(site.roads, 0, 50.0, true);
  EXPECT_NEAR(place.middle.x(), -70.0, 1e-9);
  EXPECT_NEAR(place.at(3.0).y(), 7.0, 1e-9);
  EXPECT_NEAR(site.distance_from_kerb(place.at(3.0)), 3.0, 0.05);
  EXPECT_NEAR(place.to_junction_m, 50.0, 1e-9);
}

TEST(Buildings, StandOnTheirPlotsOnly) {
  const Site site = crossroads(2, 1.0);
  Scene scene;
  const auto plots = build_buildings(site, scene);
  ASSERT_EQ(scene.fixed.size(), plots.size());
  for (std::size_t i = 0; i < plots.size(); ++i) {
    ASSERT_FALSE(scene.fixed[i].triangles.empty());
    for (const auto& vertex : scene.fixed[i].vertices) {
      // ledges, eaves, balconies and steps protrude
      ASSERT_TRUE(plots[i].contains(vertex.position.head<2>().cast<double>(), 2.3)) << "building " << i;
      ASSERT_TRUE(vertex.position.allFinite());
      ASSERT_NEAR(vertex.normal.norm(), 1.0f, 1e-3f) << "building " << i;
    }
  }
}

TEST(Buildings, ReachBelowTheGroundEverywhereOnHills) {
  const Site site = crossroads(3, 1.0);
  Scene scene;
  const auto plots = build_buildings(site, scene);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    float foot = 1e9f;
    for (const auto& vertex : scene.fixed[i].vertices) foot = std::min(foot, vertex.position.z());
    for (const auto& probe : probes_of(plots[i])) EXPECT_LT(foot, site.ground_m(probe));
  }
}

TEST(Buildings, AreTheSameForTheSameSeedAndOthersForAnother) {
  Scene first, second, third;
  build_buildings(crossroads(4), first);
  build_buildings(crossroads(4), second);
  build_buildings(crossroads(5), third);
  ASSERT_EQ(first.fixed.size(), second.fixed.size());
  std::size_t differing = first.fixed.size() == third.fixed.size() ? 0 : 1;
  for (std::size_t i = 0; i < first.fixed.size(); ++i) {
    const auto& a = first.fixed[i].vertices;
    const auto& b = second.fixed[i].vertices;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t j = 0; j < a.size(); ++j) ASSERT_EQ(a[j].position, b[j].position);
    if (i < third.fixed.size() && third.fixed[i].vertices.size() != a.size()) ++differing;
  }
  EXPECT_GT(differing, 0u);
}

TEST(Facades, DifferInEarnest) {
  const Site site = crossroads();
  const BuildingMaterials materials(*site.palette);
  std::set<std::uint16_t> walls;
  std::set<int> floors, windows, roofs;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const FacadeStyle style = draw_style(BuildingUse::kTown, *site.palette, materials, Random(1, "facades").part(i));
    walls.insert(style.wall);
    floors.insert(style.floors);
    windows.insert(static_cast<int>(style.window));
    roofs.insert(static_cast<int>(style.roof));
    EXPECT_LE(style.sill_height + style.window_height, style.floor_height);
    EXPECT_LT(style.window_width, style.bay);
    EXPECT_GE(style.recess, 0.12f);
    EXPECT_LE(style.recess, 0.25f);
  }
  EXPECT_GE(walls.size(), 7u);
  EXPECT_GE(floors.size(), 4u);
  EXPECT_GE(windows.size(), 4u);
  EXPECT_EQ(roofs.size(), 3u);
}

TEST(Facades, HaveWindowsThatLieBehindTheWallAndSillsBeforeIt) {
  const Site site = crossroads();
  const BuildingMaterials materials(*site.palette);
  FacadeStyle style = draw_style(BuildingUse::kTown, *site.palette, materials, Random(1, "facade"));
  style.recess = 0.2f;
  style.sills = true;
  WallFrame frame;
  frame.width = 15.0f;
  Mesh mesh;
  build_facade(style, materials, frame, FacadeSide::kFront, Random(1, "lights"), mesh);
  float deepest_glass = 1.0f, furthest = -1.0f, area = 0.0f;
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](int i) { return mesh.vertices[triangle.corners[static_cast<std::size_t>(i)]].position; };
    for (int i = 0; i < 3; ++i) {
      const float out = (corner(i) - frame.origin).dot(frame.outwards);
      furthest = std::max(furthest, out);
      if (triangle.material == materials.glass) deepest_glass = std::min(deepest_glass, out);
    }
    if (triangle.material == materials.glass)
      area += 0.5f * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  EXPECT_NEAR(deepest_glass, -0.2f, 0.11f);
  EXPECT_GT(furthest, 0.08f);
  EXPECT_GT(area, 0.1f * frame.width * wall_height(style));
}

}  // namespace
}  // namespace panvo::simulated_world

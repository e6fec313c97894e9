// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>

#include "../src/objects/furniture_planner.hpp"
#include "../src/objects/plants.hpp"
#include "town.hpp"

namespace panvo::simulated_world {
namespace {

/// The furnished crossroads, and which models are cars.
struct Town {
  explicit Town(std::uint64_t seed, Layout layout = Layout::kVaried, std::optional<std::uint64_t> day = {})
      : site(crossroads(seed)) {
    site.parameters.layout = layout;
    site.parameters.day = day;
    plots = build_buildings(site, scene);
    Scene only_models;
    models = build_furniture_models(*site.palette, seed, only_models);
    build_furniture(site, plots, scene);
  }
  bool is_car(std::uint32_t model) const {
    return std::count(models.cars.begin(), models.cars.end(), model) +
               std::count(models.vans.begin(), models.vans.end(), model) >
           0;
  }
  Site site;
  Scene scene;
  std::vector<Plot> plots;
  FurnitureModels models;
};

TEST(Furniture, KeepsOffTheRoadButForCarsParkedAtWideRoadsFarFromJunctions) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Town town(seed);
    ASSERT_GT(town.scene.standing.size(), 100u);
    for (const auto& placement : town.scene.standing) {
      const Eigen::Vector2d point = placement.world_from_model.translation().head<2>().cast<double>();
      const double from_kerb = town.site.distance_from_kerb(point);
      if (!town.is_car(placement.model)) {
        EXPECT_GT(from_kerb, 0.2);
      } else if (from_kerb < 0.0) {
        EXPECT_NEAR(from_kerb, -1.0, 0.25);
        EXPECT_GT(point.norm(), 15.0);
        const auto nearest = town.site.roads.nearest_road(point);
        EXPECT_GE(town.site.roads.roads[static_cast<std::size_t>(nearest.road)].width_m, 8.0);
      } else {
        EXPECT_GT(from_kerb, 1.0);
      }
    }
  }
}

TEST(Furniture, OfFieldsIsWoodsFarFromAnyRoad) {
  const Town town(6, Layout::kFields);
  EXPECT_TRUE(town.plots.empty());
  EXPECT_TRUE(town.scene.lamps.empty());
  ASSERT_GT(town.scene.standing.size(), 500u);
  for (const auto& placement : town.scene.standing) {
    EXPECT_GE(town.site.distance_from_kerb(placement.world_from_model.translation().head<2>().cast<double>()), 69.0);
  }
}

TEST(Furniture, EveryLampPostCarriesALight) {
  const Town town(4);
  const auto is_post = [&](const Placement& placement) {
    return placement.model == town.models.lamp || placement.model == town.models.lantern;
  };
  const auto& standing = town.scene.standing;
  ASSERT_GT(town.scene.lamps.size(), 3u);
  EXPECT_EQ(static_cast<std::ptrdiff_t>(town.scene.lamps.size()),
            std::count_if(standing.begin(), standing.end(), is_post));
  for (const auto& lamp : town.scene.lamps) {
    const Eigen::Vector2d below = lamp.position.head<2>().cast<double>();
    EXPECT_NEAR(lamp.position.z() - static_cast<float>(town.site.ground_m(below)), lamp.hangs ? 6.8f : 3.8f, 0.3f);
    EXPECT_TRUE(!lamp.hangs || town.site.distance_from_kerb(below) < 0.0) << "its arm reaches over the road";
  }
}

TEST(Furniture, StandsOnTheGroundAndOutsideOfBuildings) {
  const Town town(4);
  for (const auto& placement : town.scene.standing) {
    const Eigen::Vector3f place = placement.world_from_model.translation();
    const Eigen::Vector2d point = place.head<2>().cast<double>();
    EXPECT_NEAR(place.z(), town.site.ground_m(point), 1e-3);
    for (const auto& plot : town.plots) EXPECT_FALSE(plot.contains(point, 0.1));
  }
}

using Place = std::array<float, 2>;

/// Where models stand, with their number: of cars or of all else.
std::map<Place, std::uint32_t> places(const Town& town, bool of_cars) {
  std::map<Place, std::uint32_t> places;
  for (const auto& placement : town.scene.standing) {
    const Eigen::Vector3f place = placement.world_from_model.translation();
    if (town.is_car(placement.model) == of_cars) places[{place.x(), place.y()}] = placement.model;
  }
  return places;
}

TEST(Furniture, OnAnotherDayOtherCarsAreParkedAndAllElseStays) {
  for (const auto layout : {Layout::kVaried, Layout::kCarParks}) {
    const Town usual(6, layout), other(6, layout, 3), again(6, layout, 3), next(6, layout, 4);
    EXPECT_EQ(places(other, true), places(again, true));
    EXPECT_NE(places(other, true), places(next, true));
    EXPECT_EQ(places(usual, false), places(other, false));
    const auto before = places(usual, true), after = places(other, true);
    ASSERT_GE(before.size(), 10u);
    int taken = 0, differing = 0;
    for (const auto& [place, model] : after) {
      ASSERT_TRUE(before.contains(place));
      ++taken;
      differing += before.at(place) != model;
    }
    EXPECT_NEAR(taken / static_cast<double>(before.size()), kParkedAgain, 0.15);
    EXPECT_GT(differing, taken / 2);
  }
}

TEST(Furniture, ConsistsOfEqualBaysInCarParks) {
  Site site = crossroads();
  site.parameters.layout = Layout::kCarParks;
  const auto planned = plan_plots(site);
  ASSERT_GE(planned.size(), 12u);
  for (const auto& plot : planned) {
    EXPECT_EQ(plot.use, PlotUse::kOpen);
    EXPECT_EQ(plot.plot.size, planned.front().plot.size);
  }
  EXPECT_GT(places(Town(1, Layout::kCarParks), true).size(), 4 * planned.size());
}

TEST(Furniture, IsTheSameForTheSameSeed) {
  const Town first(5), second(5);
  ASSERT_EQ(first.scene.standing.size(), second.scene.standing.size());
  for (std::size_t i = 0; i < first.scene.standing.size(); ++i) {
    EXPECT_EQ(first.scene.standing[i].model, second.scene.standing[i].model);
    EXPECT_EQ(first.scene.standing[i].world_from_model.matrix(), second.scene.standing[i].world_from_model.matrix());
  }
}

TEST(Furniture, IsOfManyKinds) {
  const Town town(6);
  std::map<std::uint32_t, int> count;
  for (const auto& placement : town.scene.standing) ++count[placement.model];
  EXPECT_GE(count.size(), 20u);
  int trees = 0;
  for (const auto model : town.models.lawn_trees) trees += count[model];
  EXPECT_GT(trees, 40);
}

TEST(Trees, HaveACrownOfCardsShadedOutwardsAndATrunkInTheGround) {
  const Site site = crossroads();
  const PlantMaterials materials(*site.palette);
  for (const auto kind : {TreeKind::kBroad, TreeKind::kSpreading, TreeKind::kBirch, TreeKind::kPoplar, TreeKind::kYoung,
                          TreeKind::kSpruce, TreeKind::kPine}) {
    const Mesh mesh = build_tree(kind, materials, Random(1, "tree"));
    Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9f), high = -low;
    int leaves = 0, outwards = 0;
    for (const auto& triangle : mesh.triangles) {
      if (!site.palette->materials()[triangle.material].has_holes) continue;
      ++leaves;
      Eigen::Vector3f middle = Eigen::Vector3f::Zero();
      for (const auto corner : triangle.corners) middle += mesh.vertices[corner].position / 3.0f;
      const Eigen::Vector3f& normal = mesh.vertices[triangle.corners[0]].normal;
      if (normal.head<2>().dot(middle.head<2>()) > 0.0f || normal.z() > 0.6f) ++outwards;
    }
    for (const auto& vertex : mesh.vertices) {
      low = low.cwiseMin(vertex.position);
      high = high.cwiseMax(vertex.position);
    }
    EXPECT_GE(leaves, 180);  // two triangles per card
    EXPECT_LE(leaves, 1300);
    EXPECT_GT(outwards, 0.7 * leaves);
    EXPECT_LT(low.z(), 0.0f);
    EXPECT_GT(high.z(), 4.0f);
    EXPECT_LT(high.z(), 16.0f);
  }
}

TEST(Hedges, FitEachOther) {
  const Site site = crossroads();
  const PlantMaterials materials(*site.palette);
  // the outline at the end of one equals that at the start of the other
  const auto outline_at = [&](const Mesh& mesh, float x) {
    std::vector<Eigen::Vector2f> points;
    for (const auto& triangle : mesh.triangles) {
      for (const auto corner : triangle.corners) {
        const auto& position = mesh.vertices[corner].position;
        if (triangle.material == materials.hedge && std::abs(position.x() - x) < 1e-5f)
          points.emplace_back(position.tail<2>());
      }
    }
    return points;
  };
  const Mesh first = build_hedge(materials, 1.3f, 0.8f, Random(1, "a")),
             second = build_hedge(materials, 1.3f, 0.8f, Random(2, "b"));
  const auto ending = outline_at(first, 1.0f), beginning = outline_at(second, -1.0f);
  ASSERT_FALSE(ending.empty());
  for (const auto& point : ending) {
    float nearest = 1e9f;
    for (const auto& other : beginning) nearest = std::min(nearest, (point - other).norm());
    EXPECT_LT(nearest, 1e-4f);
  }
}

}  // namespace
}  // namespace panvo::simulated_world

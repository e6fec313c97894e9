// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "../src/objects/mover_models.hpp"
#include "town.hpp"

namespace panvo::simulated_world {
namespace {

struct Extent {
  explicit Extent(const Mesh& mesh) {
    for (const auto& vertex : mesh.vertices) {
      low = low.cwiseMin(vertex.position);
      high = high.cwiseMax(vertex.position);
    }
  }
  Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9f), high = Eigen::Vector3f::Constant(-1e9f);
};

class MoverModelsTest : public testing::Test {
 protected:
  MoverModelsTest() : site(crossroads()), models(build_mover_models(*site.palette, 1, scene)) {}
  Site site;
  Scene scene;
  MoverModels models;
};

TEST_F(MoverModelsTest, CarsAreAsBigAsCarsAndStandOnTheirWheels) {
  ASSERT_GE(models.cars.size(), 3u);
  for (const auto model : models.cars) {
    const Extent extent(scene.models[model]);
    EXPECT_NEAR(extent.low.z(), 0.0f, 0.02f);
    EXPECT_GT(extent.high.z(), 1.3f);
    EXPECT_LT(extent.high.z(), 1.8f);
    EXPECT_GT(extent.high.x() - extent.low.x(), 3.4f);
    EXPECT_LT(extent.high.x() - extent.low.x(), 4.9f);
    EXPECT_LT(extent.high.y() - extent.low.y(), 2.3f);  // with mirrors
    EXPECT_NEAR(extent.high.y(), -extent.low.y(), 0.01f);
  }
}

TEST_F(MoverModelsTest, CarsAreMadeOfPaintGlassLampsAndWheels) {
  for (const auto model : models.cars) {
    std::set<std::string> names;
    for (const auto& triangle : scene.models[model].triangles)
      names.insert(site.palette->materials()[triangle.material].name);
    for (const auto* name : {"car_paint", "car_glass", "car_trim", "tyre", "rim", "lamp_head", "lamp_rear", "plate"}) {
      EXPECT_TRUE(names.contains(name)) << name;
    }
  }
}

TEST_F(MoverModelsTest, PaintIsSmoothAndLooksOutwards) {
  for (const auto model : models.cars) {
    const Mesh& mesh = scene.models[model];
    int outwards = 0, all = 0;
    const std::uint16_t paint = site.palette->find("car_paint");
    for (const auto& triangle : mesh.triangles) {
      if (triangle.material != paint) continue;
      const auto& vertex = mesh.vertices[triangle.corners[0]];
      ++all;
      if (vertex.normal.dot(vertex.position - Eigen::Vector3f(0.3f * vertex.position.x(), 0, 0.6f)) > 0.0f) ++outwards;
    }
    EXPECT_GT(outwards, 0.9 * all);
  }
}

TEST_F(MoverModelsTest, PeopleAreAsBigAsPeopleAndDifferent) {
  ASSERT_GE(models.people.size(), 4u);
  std::set<std::size_t> sizes;
  for (const auto model : models.people) {
    const Extent extent(scene.models[model]);
    EXPECT_NEAR(extent.low.z(), 0.0f, 0.05f);
    EXPECT_NEAR(extent.high.z(), 1.79f, 0.06f);
    EXPECT_LT(extent.high.y() - extent.low.y(), 0.85f);
    sizes.insert(scene.models[model].triangles.size());
  }
  EXPECT_GE(sizes.size(), 2u);
}

TEST_F(MoverModelsTest, OwnVehicleLiesBelowThePanoramaAndOutOfTheStereoView) {
  // the stereo camera is at x 1.9 m, z 1.3 m, pitched down by 12 degrees, and sees 31 degrees further down
  const float lowest_sight = std::tan((12.0f + 31.0f) * std::numbers::pi_v<float> / 180.0f);
  const Mesh& mesh = scene.models[models.own_vehicle];
  const Extent extent(mesh);
  EXPECT_LT(extent.high.z(), 1.75f);
  EXPECT_GT(extent.high.x(), 1.95f);
  for (const auto& triangle : mesh.triangles) {
    bool is_behind = true, is_below = true;
    for (const auto corner : triangle.corners) {
      const Eigen::Vector3f& point = mesh.vertices[corner].position;
      is_behind = is_behind && point.x() < 1.9f;
      is_below = is_below && point.z() < 1.3f - lowest_sight * std::max(0.0f, point.x() - 1.9f);
    }
    EXPECT_TRUE(is_behind || is_below);
  }
}

TEST_F(MoverModelsTest, TheBodyOfTheOwnVehicleIsAsHighAsItsModel) {
  for (const auto& vertex : scene.models[models.own_vehicle].vertices) {
    constexpr float kRack = 0.25f;
    const auto [x, y, z] = std::array{vertex.position.x(), vertex.position.y(), vertex.position.z()};
    if (std::abs(x) > 2.05f || std::abs(y) > 0.85f) continue;  // lamps, plates and mirrors stand out
    EXPECT_LT(z, own_vehicle_height_m(x, y) + kRack) << vertex.position.transpose();
  }
  EXPECT_NEAR(own_vehicle_height_m(-1.0, 0.3), 1.55, 1e-6);
  EXPECT_NEAR(own_vehicle_height_m(1.0, 0.3), 0.94, 1e-6);   // before the windscreen
  EXPECT_NEAR(own_vehicle_height_m(1.55, 0.3), 0.84, 1e-6);  // on the bonnet
  EXPECT_EQ(own_vehicle_height_m(0.0, -1.0), 0.0);
  EXPECT_EQ(own_vehicle_height_m(2.2, 0.0), 0.0);
}

}  // namespace
}  // namespace panvo::simulated_world

// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/terrain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {
namespace {

Eigen::Vector2d somewhere(Random& random) { return {random.uniform(-300.0, 300.0), random.uniform(-300.0, 300.0)}; }

TEST(Terrain, IsFlatWithoutHills) {
  const Terrain terrain(7, 0.0);
  Random random(1, "terrain test");
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d point = somewhere(random);
    EXPECT_EQ(terrain.height_m(point), 0.0);
    EXPECT_EQ(terrain.normal(point), Eigen::Vector3d::UnitZ());
  }
}

TEST(Terrain, HasHillsThatRoadsCanClimbWhateverTheSeed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Terrain terrain(seed, 1.0);
    Random random(seed, "terrain test");
    double low = 1e9, high = -1e9, steepest = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector2d point = somewhere(random);
      low = std::min(low, terrain.height_m(point));
      high = std::max(high, terrain.height_m(point));
      const Eigen::Vector3d normal = terrain.normal(point);
      steepest = std::max(steepest, normal.head<2>().norm() / normal.z());
    }
    EXPECT_GT(high - low, 4.0) << "seed " << seed;
    EXPECT_LT(high - low, 10.0) << "seed " << seed;
    EXPECT_GT(steepest, 0.04) << "seed " << seed;
    EXPECT_LT(steepest, 0.095) << "seed " << seed;
  }
}

TEST(Terrain, NormalsStandOnItsSlopes) {
  const Terrain terrain(3, 1.0);
  Random random(3, "terrain test");
  constexpr double kStep_m = 0.01;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d point = somewhere(random);
    const Eigen::Vector2d x(kStep_m, 0.0), y(0.0, kStep_m);
    const Eigen::Vector3d east(2.0 * kStep_m, 0.0, terrain.height_m(point + x) - terrain.height_m(point - x));
    const Eigen::Vector3d north(0.0, 2.0 * kStep_m, terrain.height_m(point + y) - terrain.height_m(point - y));
    const Eigen::Vector3d normal = terrain.normal(point);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR(normal.dot(east.normalized()), 0.0, 1e-6);
    EXPECT_NEAR(normal.dot(north.normalized()), 0.0, 1e-6);
    EXPECT_GT(normal.z(), 0.0);
  }
}

TEST(Terrain, ScalesWithItsHillinessAndChangesWithItsSeed) {
  const Terrain half(5, 0.5), whole(5, 1.0), other(6, 1.0);
  const Eigen::Vector2d point(31.0, -77.0);
  EXPECT_NEAR(whole.height_m(point), 2.0 * half.height_m(point), 1e-12);
  EXPECT_NE(whole.height_m(point), other.height_m(point));
}

}  // namespace
}  // namespace panvo::simulated_world

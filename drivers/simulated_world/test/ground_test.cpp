// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "../src/ground/ground_grid.hpp"
#include "panvo/simulated_world/random.hpp"
#include "panvo/simulated_world/site.hpp"
#include "small_network.hpp"

namespace panvo::simulated_world {
namespace {

using Eigen::Vector2d;

std::shared_ptr<const Palette> ground_palette() {
  static const auto kPalette = std::make_shared<const Palette>(Palette::unpainted());
  return kPalette;
}

Site crossing(const SiteParameters& parameters) {
  return Site(parameters, star_network({{60, 0}, {0, 60}, {-60, 0}, {20, -55}}, 7.0), ground_palette());
}

Scene ground_of(const Site& site) {
  Scene scene;
  scene.palette = site.palette;
  build_ground(site, scene);
  return scene;
}

// Triangles indexed by the squares of a grid over the plan.
class Plan {
 public:
  explicit Plan(const Mesh& mesh) : mesh_(mesh), squares_(kSize * kSize) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Vector2d low(1e9, 1e9), high(-1e9, -1e9);
      for (const std::uint32_t corner : mesh.triangles[i].corners) {
        const Vector2d point = mesh.vertices[corner].position.head<2>().cast<double>();
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
      }
      for (int y = square(low.y()); y <= square(high.y()); ++y) {
        for (int x = square(low.x()); x <= square(high.x()); ++x) squares_[y * kSize + x].push_back(i);
      }
    }
  }

  struct Hit {
    double height_m;
    std::uint16_t material;
  };
  std::optional<Hit> highest(const Vector2d& point) const {
    std::optional<Hit> best;
    for (const std::size_t i : squares_[square(point.y()) * kSize + square(point.x())]) {
      std::array<Eigen::Vector3d, 3> corner;
      for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = mesh_.vertices[mesh_.triangles[i].corners[k]].position.cast<double>();
      }
      const Vector2d a = (corner[1] - corner[0]).head<2>(), b = (corner[2] - corner[0]).head<2>();
      const Vector2d p = point - corner[0].head<2>();
      const double area = a.x() * b.y() - a.y() * b.x();
      if (std::abs(area) < 1e-9) continue;
      const double u = (p.x() * b.y() - p.y() * b.x()) / area, v = (a.x() * p.y() - a.y() * p.x()) / area;
      constexpr double kSlack = 1e-4;
      if (u < -kSlack || v < -kSlack || u + v > 1.0 + kSlack) continue;
      const double height = corner[0].z() + u * (corner[1] - corner[0]).z() + v * (corner[2] - corner[0]).z();
      if (!best || height > best->height_m) best = Hit{height, mesh_.triangles[i].material};
    }
    return best;
  }

 private:
  static constexpr int kSize = 200;
  static int square(double m) { return std::clamp(static_cast<int>((m + 500.0) / 5.0), 0, kSize - 1); }
  const Mesh& mesh_;
  std::vector<std::vector<std::size_t>> squares_;
};

TEST(GroundGrid, CoversItsSquareOnceHoweverUneven) {
  const GroundGrid grid = adaptive_grid({3.0, 4.0}, 0.3, 1.0, 6, [](const Vector2d& middle, double edge_m) {
    return (middle - Vector2d(10.0, -5.0)).norm() < 0.5 * edge_m + 0.01;  // only triangles around the point
  });
  double area = 0.0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : grid.triangles) {
    const Vector2d a = grid.points[t[1]] - grid.points[t[0]], b = grid.points[t[2]] - grid.points[t[0]];
    EXPECT_GT(a.x() * b.y() - a.y() * b.x(), 0.0);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second);
  }
  EXPECT_NEAR(area, 64.0 * 64.0, 1e-6);
  // each edge has a neighbour, except at the border: no corner lies on another triangle's edge
  int at_border = 0;
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from})) continue;
    const Vector2d middle = 0.5 * (grid.points[from] + grid.points[to]) - Vector2d(3.0, 4.0);
    const Vector2d turned(std::cos(0.3) * middle.x() + std::sin(0.3) * middle.y(),
                          -std::sin(0.3) * middle.x() + std::cos(0.3) * middle.y());
    EXPECT_NEAR(turned.cwiseAbs().maxCoeff(), 32.0, 1e-9);
    ++at_border;
  }
  EXPECT_GE(at_border, 4);
  EXPECT_GT(grid.triangles.size(), 20u);
  EXPECT_LT(grid.triangles.size(), 200u);
}

// Each test below paints its own palette, which takes seconds, so there are few of them.

void expect_whole(const Site& site, const Scene& scene) {
  Mesh all = scene.fixed[0];
  all.append(scene.fixed[1], Eigen::Affine3f::Identity());
  const Plan plan(all);
  Random random(2, "ground test");
  for (int i = 0; i < 20000; ++i) {
    const Vector2d point{random.uniform(-75.0, 75.0), random.uniform(-75.0, 75.0)};
    const auto hit = plan.highest(point);
    ASSERT_TRUE(hit) << point.transpose();
    const double kerb_m = site.distance_from_kerb(point);
    if (std::abs(kerb_m) < 0.05 || std::abs(kerb_m - 0.15) < 0.03) continue;  // a kerb stone's edges
    EXPECT_NEAR(hit->height_m, site.ground_m(point), 0.02) << point.transpose() << ", from kerb " << kerb_m;
  }
  for (int i = 0; i < 2000; ++i) {
    const Vector2d point{random.uniform(-350.0, 350.0), random.uniform(-350.0, 350.0)};
    const auto hit = plan.highest(point);
    ASSERT_TRUE(hit) << point.transpose();
    EXPECT_NEAR(hit->height_m, site.ground_m(point), 0.25) << point.transpose();
  }
}

void expect_facing_up(const Scene& scene) {
  for (const Mesh& mesh : scene.fixed) {
    for (const Triangle& triangle : mesh.triangles) {
      const auto& [a, b, c] = triangle.corners;
      const Eigen::Vector3f normal = (mesh.vertices[b].position - mesh.vertices[a].position)
                                         .cross(mesh.vertices[c].position - mesh.vertices[a].position);
      ASSERT_GE(normal.dot(mesh.vertices[a].normal), -1e-6f);
      ASSERT_NEAR(mesh.vertices[a].normal.norm(), 1.0f, 1e-4f);
    }
  }
}

void expect_laid_closely(const Site& site, const Mesh& laid) {
  ASSERT_GT(laid.vertices.size(), 500u);
  for (const Vertex& vertex : laid.vertices) {
    const Vector2d point = vertex.position.head<2>().cast<double>();
    double above_m = vertex.position.z() - site.terrain.height_m(point);
    if (site.distance_from_kerb(point) > 0.2) above_m -= 0.12;
    ASSERT_GT(above_m, 0.001) << point.transpose();
    ASSERT_LT(above_m, 0.008) << point.transpose();
  }
}

void expect_materials(const Site& site, const Scene& scene) {
  const Plan plan(scene.fixed[0]);
  Random random(3, "ground test");
  for (int i = 0; i < 3000; ++i) {
    const Vector2d point{random.uniform(-120.0, 120.0), random.uniform(-120.0, 120.0)};
    const double kerb_m = site.distance_from_kerb(point);
    const std::string name = ground_palette()->materials()[plan.highest(point)->material].name;
    const char* expected = kerb_m < -0.4                   ? "asphalt"
                           : kerb_m > 6.5 && kerb_m < 40.0 ? "grass"
                           : kerb_m > 50.0                 ? "far_land"
                                                           : nullptr;
    if (expected) {
      EXPECT_EQ(name, expected) << point.transpose();
    }
  }
}

TEST(Ground, IsWholeOnFlatAndHillyLandAndMadeOfWhatBelongsThere) {
  for (const double hilliness : {0.0, 1.0}) {
    const Site site = crossing({.seed = 2, .hilliness = hilliness});
    const Scene scene = ground_of(site);
    expect_whole(site, scene);
    expect_facing_up(scene);
    expect_laid_closely(site, scene.fixed.at(2));
    expect_materials(site, scene);
  }
}

TEST(Ground, IsPlainAtTheHeartOfAJunctionWithWeakTextureAndTheSameForTheSameSeed) {
  const Site site = crossing({.seed = 2, .weak_texture = true});
  const Scene scene = ground_of(site);
  for (const Mesh& mesh : {scene.fixed[0], scene.fixed[1]}) {
    for (const Vertex& vertex : mesh.vertices) {
      const float away_m = vertex.position.head<2>().norm();
      if (away_m < 18.0f) {
        ASSERT_LT(vertex.tint.contrast, 40);
      }
      if (away_m > 40.0f) {
        ASSERT_EQ(vertex.tint.contrast, 255);
      }
    }
  }
  for (const Vertex& vertex : scene.fixed[2].vertices) ASSERT_GT(vertex.position.head<2>().norm(), 18.0f);
  const Plan plan(scene.fixed[0]);
  EXPECT_EQ(plan.highest({2.0, 1.0})->material, ground_palette()->find("asphalt_smooth"));

  const auto look = [](std::uint64_t seed) {
    const Scene ground = ground_of(crossing({.seed = seed}));
    std::uint64_t sum = 0;
    for (const Mesh& mesh : ground.fixed) {
      for (const Vertex& vertex : mesh.vertices) {
        for (const float coordinate : {vertex.position.x(), vertex.position.y(), vertex.position.z(), vertex.uv.x()}) {
          sum = mix(sum + static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate * 1e4f)));
        }
        sum = mix(sum + vertex.tint.red + 256u * vertex.tint.green + 65536u * vertex.tint.blue);
      }
      for (const Triangle& triangle : mesh.triangles) sum = mix(sum + triangle.corners[0] + triangle.material);
    }
    return sum;
  };
  const std::uint64_t first = look(1);
  EXPECT_EQ(first, look(1));
  EXPECT_NE(first, look(2));
}

TEST(Ground, OfTheWholeCampusKeepsToItsShareOfTriangles) {
  const Site site({.seed = 1}, campus_roads(1), ground_palette());
  const Scene scene = ground_of(site);
  std::size_t triangles = 0;
  std::set<std::string> names;
  for (const Mesh& mesh : scene.fixed) {
    triangles += mesh.triangles.size();
    for (const Triangle& triangle : mesh.triangles) names.insert(ground_palette()->materials()[triangle.material].name);
  }
  EXPECT_LT(triangles, 600000u);
  for (const char* name : {"asphalt", "asphalt_patch", "concrete", "kerb", "slabs", "cobbles", "grass", "marking",
                           "manhole", "far_land"}) {
    EXPECT_TRUE(names.count(name)) << name;
  }
}

}  // namespace
}  // namespace panvo::simulated_world

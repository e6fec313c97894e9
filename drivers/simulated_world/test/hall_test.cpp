// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "../src/plots.hpp"
#include "render_scenes.hpp"
#include "town.hpp"

namespace panvo::simulated_world {
namespace {

struct Hall {
  explicit Hall(std::uint64_t seed, std::optional<std::uint64_t> day = {}) : site(crossroads(seed)) {
    site.parameters.layout = Layout::kHall;
    site.parameters.day = day;
    scene->palette = site.palette;
    scene->sky = std::make_shared<const Sky>(seed);
    build_hall(site, *scene);
  }

  /// The corners of what stands on plots, which are the last meshes.
  std::set<std::tuple<float, float, float>> corners_on_plots() const {
    std::set<std::tuple<float, float, float>> corners;
    for (std::size_t i = scene->fixed.size() - plan_plots(site).size(); i < scene->fixed.size(); ++i) {
      for (const auto& vertex : scene->fixed[i].vertices)
        corners.emplace(vertex.position.x(), vertex.position.y(), vertex.position.z());
    }
    return corners;
  }

  Site site;
  std::shared_ptr<Scene> scene = std::make_shared<Scene>();
};

TEST(Halls, LeaveTheirAislesFree) {
  const Hall hall(1);
  int standing = 0;
  for (const Mesh& mesh : hall.scene->fixed) {
    for (const Vertex& vertex : mesh.vertices) {
      if (vertex.position.z() < 0.01f) continue;  // the floor and what is painted on it
      ++standing;
      ASSERT_GT(hall.site.distance_from_kerb(vertex.position.head<2>().cast<double>()), 0.2);
    }
  }
  EXPECT_GT(standing, 10'000);
}

TEST(Halls, ConsistOfSurfacesWithNormals) {
  const Hall hall(1);
  const auto check = [](const Mesh& mesh) {
    for (const Vertex& vertex : mesh.vertices) ASSERT_NEAR(vertex.normal.norm(), 1.0f, 1e-4f) << vertex.position;
  };
  for (const Mesh& mesh : hall.scene->fixed) check(mesh);
  for (const Mesh& mesh : hall.scene->models) check(mesh);
}

TEST(Halls, HaveNoViewOutside) {
  const Hall hall(2);
  const auto pose = looking({30.3, 0.7, 1.8});  // not where tiles meet: a ray may pass exactly between two
  const cv::Mat1f range = Renderer(hall.scene).render_range(panorama_rays(180, 90), still(pose, kToPanorama), {});
  EXPECT_LT(*std::max_element(range.begin(), range.end()), 400.0f);
  EXPECT_NEAR(range(0, 0), 7.5f - 1.8f, 0.7f) << "the roof, or a beam";
}

TEST(Halls, AreLitFromAboveTheirAisles) {
  const Hall hall(3);
  EXPECT_GE(hall.scene->lamps.size(), 40u);
  for (const Lamp& lamp : hall.scene->lamps) {
    EXPECT_TRUE(lamp.hangs);
    EXPECT_LT(hall.site.distance_from_kerb(lamp.position.head<2>().cast<double>()), -3.0);
  }
}

TEST(Halls, HoldAFifthOfOtherGoodsOnAnotherDay) {
  const auto usual = Hall(4).corners_on_plots(), same = Hall(4).corners_on_plots();
  const auto other = Hall(4, 3).corners_on_plots();
  EXPECT_EQ(usual, same);
  const auto remaining =
      std::count_if(usual.begin(), usual.end(), [&](const auto& corner) { return other.contains(corner); });
  const double share = static_cast<double>(remaining) / static_cast<double>(usual.size());
  EXPECT_GT(share, 0.75);  // posts and beams of shelves stay, too
  EXPECT_LT(share, 0.95);
}

}  // namespace
}  // namespace panvo::simulated_world

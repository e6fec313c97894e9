// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "render_scenes.hpp"

namespace panvo::simulated_world {
namespace {

const Eigen::Vector3d kEye(0.0, 0.0, 1.5);

/// Even ground of one material, wet or dry.
std::shared_ptr<Scene> ground_of(std::string_view material, bool is_wet) {
  static const auto wet = scene_palette(Season::kSummer, true);
  auto scene = empty_scene();
  if (is_wet) scene->palette = wet;
  Mesh mesh;
  add_square(mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 200.0f, kWhite, 0.0f, material);
  scene->fixed.push_back(mesh);
  return scene;
}

void add_black_wall(Scene& scene) {
  Mesh wall;
  add_square(wall, {30.0f, 0.0f, 5.0f}, -Eigen::Vector3f::UnitX(), 10.0f, kBlack);
  scene.fixed.push_back(wall);
}

Light clouds() {
  Light light = overcast_light_at(12.0);
  light.haze_per_m = 0.0f;
  return light;
}

/// The picture from `kEye`, without edge samples.
cv::Mat view_of(const std::shared_ptr<Scene>& scene, const Light& light) {
  return Renderer(scene).render(pinhole_rays(camera()), still(looking(kEye)), light, {}, {.edge_samples = 0});
}

float lightness(const cv::Mat& image, const Eigen::Vector3d& place) {
  const auto pixel = pixel_of(looking(kEye).inverse() * place);
  return grey(image, static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
}

/// How much darker a wall makes the ground before it, 1: not at all.
float before_wall(std::string_view material, bool is_wet, const Eigen::Vector3d& place) {
  const auto open = ground_of(material, is_wet), walled = ground_of(material, is_wet);
  add_black_wall(*walled);
  return lightness(view_of(walled, clouds()), place) / lightness(view_of(open, clouds()), place);
}

TEST(RendererInTheWet, RoadsMirrorWhatStandsBehindThemAtGrazingAngles) {
  const Eigen::Vector3d far(20.0, 0.0, 0.0), near(3.0, 0.0, 0.0);
  EXPECT_GT(before_wall("asphalt", false, far), 0.9f);
  EXPECT_LT(before_wall("asphalt", true, far), 0.75f);
  EXPECT_GT(before_wall("asphalt", true, near), 0.9f);
}

TEST(RendererInTheWet, RoadsAreDarkerAndGrassIsAsBefore) {
  auto downwards = looking(kEye);
  downwards.rotate(Eigen::AngleAxisd(-1.5, Eigen::Vector3d::UnitX()));
  const auto on = [&](std::string_view material, bool is_wet) {
    Renderer renderer(ground_of(material, is_wet));
    return grey(renderer.render(pinhole_rays(camera()), still(downwards), clouds(), {}, {}), 120, 160);
  };
  EXPECT_LT(on("asphalt", true), 0.75f * on("asphalt", false));
  EXPECT_EQ(on("grass", true), on("grass", false));
}

TEST(RendererInTheWet, PuddlesLieHereAndThereOnLevelGround) {
  // black, so that only what is mirrored is seen
  const auto shares = [](float slope) {
    auto scene = ground_of("grass", true);
    Mesh mesh;
    add_square(mesh, {0.0f, 0.0f, 0.01f}, {0.0f, slope, 1.0f}, 100.0f, kBlack, 0.0f, "marking");
    scene->fixed.push_back(mesh);
    const auto image = view_of(scene, clouds());
    const float sky = grey(image, 86, 160);  // that which the middle of row 150 mirrors
    int puddles = 0, films = 0;
    for (int column = 0; column < image.cols; ++column) {
      (grey(image, 150, column) > 0.4f * sky ? puddles : films) += 1;
    }
    return std::pair(puddles, films);
  };
  const auto [puddles, films] = shares(0.0f);
  EXPECT_GT(puddles, 20);
  EXPECT_GT(films, puddles);
  EXPECT_EQ(shares(0.06f).first, 0);
}

TEST(RendererInTheWet, LampsDrawStreaksOnTheRoad) {
  Light light = night_light(true, 1);
  light.haze_per_m = 0.0f;
  const auto on = [&](bool is_wet, double y) {
    auto scene = ground_of("asphalt", is_wet);
    scene->lamps = {{{24.0f, 0.0f, 6.0f}, 2.0f, false}};
    const auto image = view_of(scene, light);
    float sum = 0.0f;
    for (double x = 4.0; x < 12.0; x += 0.5) sum += lightness(image, {x, y, 0.0});
    return sum;
  };
  EXPECT_GT(on(true, 0.0), 2.0f * on(false, 0.0));
  EXPECT_LT(on(true, 4.0), 0.5f * on(true, 0.0));
}

}  // namespace
}  // namespace panvo::simulated_world

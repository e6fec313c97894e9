// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "render_scenes.hpp"

namespace panvo::simulated_world {
namespace {

const Eigen::Vector3d kSpot(10.0, 0.0, 0.0);

std::shared_ptr<Scene> white_plain(const std::vector<Lamp>& lamps = {}) {
  auto scene = empty_scene();
  Mesh mesh;
  add_square(mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 200.0f, kWhite);
  scene->fixed.push_back(mesh);
  scene->lamps = lamps;
  return scene;
}

Light clear_night() {
  Light light = night_light(false, 1);
  light.haze_per_m = 0.0f;
  return light;
}

cv::Mat picture(const std::shared_ptr<Scene>& scene, const Light& light) {
  return Renderer(scene).render(pinhole_rays(camera()), still(looking({0.0, 0.0, 1.5})), light, {}, {});
}

float at(const cv::Mat& image, const Eigen::Vector3d& place) {
  const auto pixel = pixel_of(looking({0.0, 0.0, 1.5}).inverse() * place);
  return grey(image, static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
}

/// What lamps add to the light of the night.
float lamplight(const std::vector<Lamp>& lamps, const Eigen::Vector3d& place = kSpot) {
  return at(picture(white_plain(lamps), clear_night()), place) - at(picture(white_plain(), clear_night()), place);
}

TEST(RendererAtNight, LampsLightTheGroundByTheInverseSquareOfTheirDistance) {
  const float near = lamplight({{{10.0f, 0.0f, 4.0f}, 1.0f, false}});
  EXPECT_GT(near, 0.02f);
  EXPECT_NEAR(lamplight({{{10.0f, 0.0f, 8.0f}, 1.0f, false}}) / near, 0.25f, 0.01f);
  EXPECT_NEAR(lamplight({{{10.0f, 0.0f, 4.0f}, 1.0f, false}, {{10.0f, 0.0f, 4.0f}, 0.5f, false}}) / near, 1.5f, 0.01f);
  EXPECT_NEAR(lamplight({{{70.0f, 0.0f, 4.0f}, 1.0f, false}}), 0.0f, 1e-5f);  // too far
  const float faint = 100.0f * 4.0f / std::pow(44.2f, 3.0f);  // by the inverse square, at the angle there
  EXPECT_LT(lamplight({{{54.0f, 0.0f, 4.0f}, 100.0f, false}}), 0.3f * faint) << "fades before it ends";
}

TEST(RendererAtNight, ALampThatHangsLightsLittleBesideIt) {
  const auto beside = [](bool hangs) { return lamplight({{{10.0f, 8.0f, 1.0f}, 1.0f, hangs}}); };
  const auto below = [](bool hangs) { return lamplight({{{10.0f, 0.0f, 6.0f}, 1.0f, hangs}}); };
  EXPECT_LT(beside(true), 0.4f * beside(false));
  EXPECT_NEAR(below(true), below(false), 0.01f * below(false));
}

TEST(RendererAtNight, WhatStandsBeforeTheBrightestLampCastsAShadow) {
  auto scene = white_plain({{{10.0f, 6.0f, 4.0f}, 1.0f, false}, {{10.0f, -20.0f, 4.0f}, 1.0f, false}});
  const auto open = picture(scene, clear_night());
  Mesh wall;
  add_square(wall, {10.0f, 2.0f, 1.0f}, Eigen::Vector3f::UnitY(), 3.0f, kWhite);
  scene->fixed.push_back(wall);
  const auto shaded = picture(scene, clear_night());
  EXPECT_LT(at(shaded, kSpot), 0.5f * at(open, kSpot));
  EXPECT_GT(at(shaded, kSpot), 1.1f * at(picture(white_plain(), clear_night()), kSpot)) << "the other lamp";
}

TEST(RendererAtNight, LampsAreOffByDay) {
  const auto with = white_plain({{{10.0f, 0.0f, 4.0f}, 1.0f, false}});
  EXPECT_EQ(at(picture(with, plain_light()), kSpot), at(picture(white_plain(), plain_light()), kSpot));
}

TEST(RendererAtNight, SomeRoomsAreLitAndOthersOnAnotherEvening) {
  auto scene = white_plain({{{-40.0f, 0.0f, 4.0f}, 1e-6f, false}});
  Mesh front;
  add_square(front, {30.0f, 0.0f, 0.0f}, -Eigen::Vector3f::UnitX(), 60.0f, {}, 0.0f, "glass");
  scene->fixed.push_back(front);
  const auto lit_rows = [&](Light light, std::uint32_t evening) {
    light.evening = evening;
    light.haze_per_m = 0.0f;
    std::vector<bool> lit;
    const auto image = picture(scene, light);
    for (int y = -18; y <= 18; y += 4) {
      for (int z = 2; z <= 11; z += 3) lit.push_back(at(image, {30.0, y + 0.5, z - 0.5}) > 0.012f);
    }
    return lit;
  };
  const auto evening = lit_rows(night_light(false, 1), 1);
  const auto count = std::count(evening.begin(), evening.end(), true);
  EXPECT_GT(count, 5);
  EXPECT_LT(count, 20);  // of 40
  EXPECT_EQ(evening, lit_rows(night_light(false, 1), 1));
  EXPECT_NE(evening, lit_rows(night_light(false, 1), 2));
}

}  // namespace
}  // namespace panvo::simulated_world

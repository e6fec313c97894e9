// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "render_scenes.hpp"

namespace panvo::simulated_world {
namespace {

TEST(Renderer, ShadesAWhiteSurfaceAsTheLightSays) {
  auto scene = empty_scene();
  Mesh mesh;
  add_square(mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 200.0f, kWhite);
  scene->fixed.push_back(mesh);
  Renderer renderer(scene);
  auto pose = looking({0.0, 0.0, 2.0});
  pose.rotate(Eigen::AngleAxisd(-1.2, Eigen::Vector3d::UnitX()));  // down
  Light light = plain_light();
  light.to_sun = Eigen::Vector3f(0.6f, 0.0f, 0.8f);
  const auto image = renderer.render(pinhole_rays(camera()), still(pose), light, {}, {});
  const auto& white = campus_palette()->materials()[plain_material()];
  const Eigen::Vector3f expected =
      white.tint.cwiseProduct(white.albedo->mean().head<3>()).cwiseProduct(0.8f * light.sun + light.sky);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at<cv::Vec3f>(120, 160)[c], expected[c], 0.01);
}

TEST(Renderer, LaysSnowOnWhatFacesUpwards) {
  static const auto winter = scene_palette(Season::kSnow);
  auto scene = empty_scene();
  auto snowy = empty_scene();
  snowy->palette = winter;
  for (const auto& one : {scene, snowy}) {
    Mesh mesh;
    add_square(mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 200.0f, {}, 0.0f, "grass");
    add_square(mesh, {10.0f, 0.0f, 2.0f}, -Eigen::Vector3f::UnitX(), 4.0f, {}, 0.0f, "brick_red");
    one->fixed.push_back(mesh);
  }
  Light light = plain_light();
  light.ground.setZero();
  const auto pose = looking({0.0, 0.0, 1.5});
  const auto of = [&](const std::shared_ptr<Scene>& from) {
    return Renderer(from).render(pinhole_rays(camera()), still(pose), light, {}, {});
  };
  const auto bare = of(scene), white = of(snowy);
  EXPECT_GT(grey(white, 220, 160), 2.0f * grey(bare, 220, 160));    // the ground in front
  EXPECT_NEAR(grey(white, 110, 160), grey(bare, 110, 160), 1e-3f);  // the wall
}

/// Brightness of the ground at a place, relative to open ground.
double relative_brightness(Renderer& renderer, const Eigen::Vector3d& place, const Light& light,
                           std::span<const MovingPlacement> movers = {}) {
  static const auto bare = [] {
    auto scene = empty_scene();
    Mesh mesh;
    add_square(mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::UnitZ(), 200.0f, {}, 0.0f, "asphalt");
    scene->fixed.push_back(mesh);
    return std::make_unique<Renderer>(scene);
  }();
  auto pose = looking({0.0, 0.0, 1.5});
  const Eigen::Vector2d pixel = pixel_of(pose.inverse() * place);
  const auto rays = pinhole_rays(camera());
  const auto at = [&](Renderer& from, std::span<const MovingPlacement> with) {
    const auto image = from.render(rays, still(pose), light, with, {});
    return grey(image, static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x())));
  };
  return at(renderer, movers) / at(*bare, {});
}

TEST(Renderer, CastsShadowsWhereTheSunSaysSo) {
  Renderer renderer(yard());
  Light light = plain_light();
  light.to_sun = Eigen::Vector3f(0.0f, 1.0f, 1.0f).normalized();  // the box of 2 m casts a shadow of 2 m towards -y
  EXPECT_LT(relative_brightness(renderer, {8.0, -1.2, 0.0}, light), 0.5);
  EXPECT_LT(relative_brightness(renderer, {8.0, -2.2, 0.0}, light), 0.5);
  EXPECT_GT(relative_brightness(renderer, {8.0, -2.9, 0.0}, light), 0.8);
  EXPECT_GT(relative_brightness(renderer, {6.5, -1.5, 0.0}, light), 0.8);
}

TEST(Renderer, LetsAnUnseenMoverCastItsShadow) {
  Renderer renderer(yard());
  Light light = plain_light();
  light.to_sun = Eigen::Vector3f(0.0f, 0.0f, 1.0f);
  const std::vector<MovingPlacement> without{car_at(8.0f, -3.0f, kToPanorama)};
  const std::vector<MovingPlacement> with{car_at(8.0f, -3.0f, kToShadow)};
  EXPECT_GT(relative_brightness(renderer, {7.0, -3.0, 0.0}, light, without), 0.9);
  EXPECT_LT(relative_brightness(renderer, {7.0, -3.0, 0.0}, light, with), 0.5);
}

}  // namespace
}  // namespace panvo::simulated_world

// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

#include "render_scenes.hpp"

namespace panvo::simulated_world {
namespace {

/// Centroid of the bright pixels, px.
Eigen::Vector2d centroid(const cv::Mat& image) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const double light = grey(image, row, column);
      sum += light * Eigen::Vector2d(column, row);
      weight += light;
    }
  }
  return sum / weight;
}

/// A white square surrounded by a black wall.
std::shared_ptr<Scene> marker_scene(const Eigen::Vector3f& middle, const Eigen::Vector3f& normal, float side) {
  auto scene = empty_scene();
  Mesh mesh;
  Eigen::Isometry3f room = Eigen::Isometry3f::Identity();
  mesh.add_box(room, Eigen::Vector3f::Constant(200.0f), plain_material(), kBlack);
  add_square(mesh, middle, normal, side, kWhite, 0.4f);
  scene->fixed.push_back(mesh);
  return scene;
}

TEST(Renderer, ShowsAMarkerWhereItsCameraProjectsIt) {
  const auto pose = looking({1.0, 2.0, 1.5}, 0.3);
  const auto rays = pinhole_rays(camera());
  for (const Eigen::Vector3d& in_camera :
       {Eigen::Vector3d(0.2, 0.1, 6.0), Eigen::Vector3d(-3.1, 1.5, 6.5), Eigen::Vector3d(3.0, -2.0, 6.3)}) {
    const Eigen::Vector3d point = pose * in_camera;
    const Eigen::Vector3f normal = (-(pose.linear() * in_camera)).normalized().cast<float>();
    Renderer renderer(marker_scene(point.cast<float>(), normal, 0.25f));
    // the square's centre in the image, averaged over the square
    Eigen::Vector2d expected = Eigen::Vector2d::Zero();
    const Eigen::Vector3d across = in_camera.unitOrthogonal();
    const Eigen::Vector3d along = in_camera.normalized().cross(across);
    for (const double u : {-0.09, 0.09}) {
      for (const double v : {-0.09, 0.09}) expected += 0.25 * pixel_of(in_camera + u * across + v * along);
    }
    const auto error = [&](const Renderer::Quality& quality) {
      const auto image = renderer.render(rays, still(pose), plain_light(), {}, quality);
      return (centroid(image) - expected).norm();
    };
    EXPECT_LT(error({16, 4}), 0.05) << in_camera.transpose();
    EXPECT_LT(error({}), 0.1) << in_camera.transpose();
  }
}

TEST(Renderer, ShowsAMarkerAtItsBearingInAPanorama) {
  const auto pose = looking({1.0, 2.0, 1.5}, -0.7);
  for (const double azimuth : {0.3, -2.0, 2.9}) {
    const Eigen::Vector3d in_camera(8.0 * std::sin(azimuth), -1.0, 8.0 * std::cos(azimuth));
    const Eigen::Vector3f normal = (-(pose.linear() * in_camera)).normalized().cast<float>();
    Renderer renderer(marker_scene((pose * in_camera).cast<float>(), normal, 0.5f));
    const auto image = renderer.render(panorama_rays(1080, 540), still(pose, kToPanorama), plain_light(), {}, {});
    const Eigen::Vector2d seen = centroid(image);
    EXPECT_NEAR(seen.x(), (azimuth + std::numbers::pi) * 1080.0 / (2.0 * std::numbers::pi), 0.05);
    EXPECT_NEAR(seen.y(), (std::atan2(-1.0, 8.0) + std::numbers::pi / 2.0) * 540.0 / std::numbers::pi, 0.05);
  }
}

TEST(Renderer, ShowsAMovingCamerasMarkerWhereItIsHalfWay) {
  const auto opened = looking({0.0, 0.0, 1.5});
  const auto closed = looking({0.0, -0.1, 1.5}, 0.02);
  const auto half = looking({0.0, -0.05, 1.5}, 0.01);
  const Eigen::Vector3d point(6.0, 0.2, 1.4);
  Renderer renderer(marker_scene(point.cast<float>(), -Eigen::Vector3f::UnitX(), 0.5f));
  const auto image = renderer.render(pinhole_rays(camera()), {opened, closed, kToStereo}, plain_light(), {}, {8, 4});
  EXPECT_LT((centroid(image) - pixel_of(half.inverse() * point)).norm(), 0.1);
}

TEST(Renderer, RangesFitTheDisparityOfAStereoPair) {
  Renderer renderer(yard());
  vision::LensCamera straight = camera();
  straight.distortion = {};
  const auto rays = pinhole_rays(straight);
  const auto left = looking({0.0, 0.0, 1.5});
  auto right = left;
  right.translate(Eigen::Vector3d(0.12, 0.0, 0.0));
  const cv::Mat from_left = renderer.render_range(rays, still(left), {});
  const cv::Mat from_right = renderer.render_range(rays, still(right), {});
  int compared = 0;
  for (int row = 60; row < 230; row += 5) {
    for (int column = 20; column < 300; column += 5) {
      const float range = from_left.at<float>(row, column);
      if (!std::isfinite(range)) continue;
      const auto direction = rays.directions[static_cast<std::size_t>(row * 320 + column)].cast<double>();
      const Eigen::Vector3d point = direction * range;
      const double disparity = straight.pinhole.fx * 0.12 / point.z();
      const double other_column = column - disparity;
      const int x = static_cast<int>(std::floor(other_column));
      if (x < 1 || x > 317) continue;
      const double share = other_column - x;
      const double a = from_right.at<float>(row, x);
      const double b = from_right.at<float>(row, x + 1);
      if (std::abs(a - b) > 0.1 * a) continue;  // an edge
      const double expected = (point - Eigen::Vector3d(0.12, 0.0, 0.0)).norm();
      if (a < 0.9 * expected) continue;  // the box hides it
      EXPECT_NEAR(a + share * (b - a), expected, 0.002 * expected);
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(Renderer, PutsMoversWhereTheyAreAndThenSomewhereElse) {
  Renderer renderer(yard());
  const auto rays = pinhole_rays(camera());
  const auto pose = looking({0.0, -4.0, 1.0});
  const Eigen::Vector2d ahead = pixel_of({0.0, 0.0, 5.0});
  const auto range_with = [&](const std::vector<MovingPlacement>& movers) {
    const cv::Mat range = renderer.render_range(rays, still(pose), movers);
    return range.at<float>(static_cast<int>(std::lround(ahead.y())), static_cast<int>(std::lround(ahead.x())));
  };
  EXPECT_NEAR(range_with({car_at(8.0f, -4.0f)}), 6.0, 0.01);
  EXPECT_NEAR(range_with({car_at(12.0f, -4.0f), car_at(20.0f, -4.0f)}), 10.0, 0.01);
  EXPECT_EQ(range_with({car_at(12.0f, -4.0f, kToPanorama)}), range_with({}));
  EXPECT_GT(range_with({}), 50.0);
}

TEST(Renderer, SeesThroughTheHolesOfLeaves) {
  const auto& leaves = campus_palette()->materials()[campus_material("leaves_broad")];
  ASSERT_TRUE(leaves.has_holes);
  // a position in the middle of a hole, or of a leaf
  const auto place_of = [&](bool is_hole) {
    Eigen::Vector2f best = Eigen::Vector2f::Zero();
    float found = is_hole ? 1e9f : -1e9f;
    for (float u = 0.0f; u < 1.0f; u += 0.02f) {
      for (float v = 0.0f; v < 1.0f; v += 0.02f) {
        float sum = 0.0f;
        for (const float d : {-0.01f, 0.0f, 0.01f}) {
          for (const float e : {-0.01f, 0.0f, 0.01f}) sum += leaves.albedo->alpha({u + d, v + e});
        }
        if (is_hole ? sum < found : sum > found) {
          found = sum;
          best = {u, v};
        }
      }
    }
    return best;
  };
  for (const bool is_hole : {true, false}) {
    auto scene = empty_scene();
    Mesh mesh;
    add_square(mesh, {10.0f, 0.0f, 1.5f}, -Eigen::Vector3f::UnitX(), 4.0f, kWhite);
    add_square(mesh, {5.0f, 0.0f, 1.5f}, -Eigen::Vector3f::UnitX(), 4.0f, {}, 0.0f, "leaves_broad");
    for (std::size_t i = 4; i < 8; ++i) mesh.vertices[i].uv = place_of(is_hole) * leaves.period_m;
    scene->fixed.push_back(mesh);
    Renderer renderer(scene);
    const cv::Mat range = renderer.render_range(pinhole_rays(camera()), still(looking({0.0, 0.0, 1.5})), {});
    EXPECT_NEAR(range.at<float>(118, 162), is_hole ? 10.0 : 5.0, 0.01);
  }
}

double max_difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(Renderer, GivesTheSamePictureWithAnyNumberOfThreads) {
  auto scene = yard();
  scene->standing.push_back({0, Eigen::Translation3f(15.0f, 3.0f, 0.0f) * Eigen::Affine3f::Identity(), {}, kToAll});
  const std::vector<MovingPlacement> movers{car_at(12.0f, -3.0f)};
  const auto rays = pinhole_rays(camera());
  const Shot shot{looking({0.0, 0.0, 1.5}), looking({0.05, 0.0, 1.5}, 0.01), kToStereo};
  const auto picture = [&] {
    Renderer renderer(scene);
    return renderer.render(rays, shot, Light{}, movers, {});
  };
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat alone = picture();
  cv::setNumThreads(2);
  const cv::Mat together = picture();
  cv::setNumThreads(threads);
  EXPECT_EQ(max_difference(alone, together), 0.0);
  Renderer renderer(scene);
  EXPECT_EQ(max_difference(alone, renderer.render(rays, shot, Light{}, movers, {})), 0.0);
  renderer.render(rays, shot, Light{}, {}, {});
  EXPECT_EQ(max_difference(alone, renderer.render(rays, shot, Light{}, movers, {})), 0.0);
}

TEST(Renderer, CountsWhatItTraces) {
  Renderer renderer(yard());
  renderer.render(pinhole_rays(camera()), still(looking({0.0, 0.0, 1.5})), Light{}, {}, {0, 4});
  const auto statistics = renderer.statistics();
  EXPECT_EQ(statistics.pixels, 320u * 240u);
  EXPECT_EQ(statistics.primary_rays, statistics.pixels);
  EXPECT_GT(statistics.shadow_rays, statistics.pixels / 4);
  EXPECT_LT(statistics.shadow_rays, statistics.pixels);
  EXPECT_EQ(statistics.triangles, 2u + 12u);
}

TEST(Renderer, RefusesASceneThatIsNotWhole) {
  auto scene = empty_scene();
  scene->sky = nullptr;
  EXPECT_THROW(Renderer{scene}, std::invalid_argument);
  scene = yard();
  scene->fixed[0].triangles[0].material = 999;
  EXPECT_THROW(Renderer{scene}, std::invalid_argument);
  scene = yard();
  scene->standing.push_back({7, Eigen::Affine3f::Identity(), {}, kToAll});
  EXPECT_THROW(Renderer{scene}, std::invalid_argument);
}

}  // namespace
}  // namespace panvo::simulated_world

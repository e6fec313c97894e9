// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/camera_rays.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "panvo/vision/camera_model.hpp"

namespace panvo::simulated_world {
namespace {

vision::LensCamera street_camera() {
  vision::LensCamera camera;
  camera.pinhole = {458.0, 457.0, 322.5, 238.25, 640, 480};
  camera.distortion = {-0.28, 0.074, 0.0002, -0.0003, -0.004};
  return camera;
}

Eigen::Vector2d image_point(const vision::CameraModel& camera, const Eigen::Vector3d& direction) {
  return camera.project(direction).value();
}

const Eigen::Vector3f& at(const CameraRays& rays, int column, int row) {
  return rays.directions[static_cast<std::size_t>(row * rays.width + column)];
}

TEST(PinholeRays, AreSeenAtTheirPixels) {
  const vision::CameraModel model(street_camera());
  const auto rays = pinhole_rays(model.camera());
  ASSERT_EQ(rays.directions.size(), 640u * 480u);
  double worst = 0.0;
  for (int row = 0; row < rays.height; row += 7) {
    for (int column = 0; column < rays.width; column += 9) {
      const Eigen::Vector3d direction = at(rays, column, row).cast<double>();
      EXPECT_NEAR(direction.norm(), 1.0, 1e-6);
      worst = std::max(worst, (image_point(model, direction) - Eigen::Vector2d(column, row)).norm());
    }
  }
  EXPECT_LT(worst, 1e-3);  // single precision
}

TEST(PinholeRays, AreExactBetweenPixelsToo) {
  const vision::CameraModel model(street_camera());
  const auto rays = pinhole_rays(model.camera());
  for (const Eigen::Vector2f& place : {Eigen::Vector2f(-0.5f, -0.5f), Eigen::Vector2f(0.5f, 0.5f),
                                       Eigen::Vector2f(320.25f, 200.75f), Eigen::Vector2f(639.5f, 479.5f)}) {
    const Eigen::Vector3d direction = rays.direction(place.x(), place.y()).cast<double>();
    EXPECT_LT((image_point(model, direction) - place.cast<double>()).norm(), 3e-3) << place.transpose();
  }
}

TEST(PinholeRays, AreRefusedForCamerasThatCannotBe) {
  auto no_focus = street_camera();
  no_focus.pinhole.fx = 0.0;
  EXPECT_THROW(pinhole_rays(no_focus), std::invalid_argument);
  auto folded = street_camera();
  folded.distortion = {-0.6, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THROW(pinhole_rays(folded), std::invalid_argument);
  auto empty = street_camera();
  empty.pinhole.width = 0;
  EXPECT_THROW(pinhole_rays(empty), std::invalid_argument);
}

TEST(PanoramaRays, FollowThePaper) {  // [Lu2015 Eqs. 9, 10]
  const auto rays = panorama_rays(1080, 540);
  EXPECT_TRUE(rays.wraps);
  EXPECT_TRUE(at(rays, 540, 270).isApprox(Eigen::Vector3f(0, 0, 1), 1e-6f));  // the centre looks ahead
  EXPECT_TRUE(at(rays, 810, 270).isApprox(Eigen::Vector3f(1, 0, 0), 1e-6f));  // a quarter further: to the right
  EXPECT_LT(at(rays, 540, 180).y(), 0.0f);
  EXPECT_NEAR(std::asin(-at(rays, 540, 180).y()), std::numbers::pi / 6.0, 1e-6);  // row 180: 30 degrees up
  for (const auto& direction : {at(rays, 3, 17), at(rays, 700, 400), at(rays, 1079, 539)}) {
    const double azimuth = std::atan2(direction.x(), direction.z());
    const double elevation = std::atan2(direction.y(), std::hypot(direction.x(), direction.z()));
    const double u = (azimuth + std::numbers::pi) * 1080.0 / (2.0 * std::numbers::pi);
    const double v = (elevation + std::numbers::pi / 2.0) * 540.0 / std::numbers::pi;
    EXPECT_TRUE(rays.direction(static_cast<float>(u), static_cast<float>(v)).isApprox(direction, 1e-5f));
  }
}

TEST(PanoramaRays, GoOnBehindTheLastColumn) {
  const auto rays = panorama_rays(1080, 540);
  EXPECT_TRUE(rays.direction(1079.5f, 270.0f).isApprox(rays.direction(-0.5f, 270.0f), 1e-6f));
  EXPECT_TRUE(rays.direction(1080.0f, 100.0f).isApprox(at(rays, 0, 100), 1e-6f));
  EXPECT_THROW(panorama_rays(0, 540), std::invalid_argument);
}

TEST(FisheyeRays, BendAsTheModelSays) {
  FisheyeCamera camera;
  camera.pinhole = {210.0, 211.0, 400.0, 398.0, 800, 800};
  camera.distortion = {0.02, -0.004, 0.0005, -0.00005};
  camera.field_of_view_rad = 3.3;
  const auto rays = fisheye_rays(camera);
  int seen = 0;
  for (int row = 0; row < rays.height; row += 11) {
    for (int column = 0; column < rays.width; column += 11) {
      const Eigen::Vector3d direction = at(rays, column, row).cast<double>();
      if (direction.isZero()) continue;
      ++seen;
      const double side = direction.head<2>().norm();
      const double t = std::atan2(side, direction.z());
      EXPECT_LT(t, 1.651);
      const double t2 = t * t;
      const double radius = t * (1.0 + t2 * (0.02 + t2 * (-0.004 + t2 * (0.0005 - t2 * 0.00005))));
      const double scale = side > 0.0 ? radius / side : 0.0;
      EXPECT_NEAR(210.0 * scale * direction.x() + 400.0, column, 2e-3);
      EXPECT_NEAR(211.0 * scale * direction.y() + 398.0, row, 2e-3);
    }
  }
  EXPECT_GT(seen, 2000);
  EXPECT_TRUE(at(rays, 0, 0).isZero());  // the corners see nothing
  EXPECT_TRUE(rays.direction(0.5f, 0.5f).isZero());
}

TEST(FisheyeRays, AreRefusedWhereTheImageFolds) {
  FisheyeCamera camera;
  camera.pinhole = {210.0, 210.0, 400.0, 400.0, 800, 800};
  camera.distortion = {-0.3, 0.0, 0.0, 0.0};
  EXPECT_THROW(fisheye_rays(camera), std::invalid_argument);
  camera.distortion = {};
  camera.field_of_view_rad = 7.0;
  EXPECT_THROW(fisheye_rays(camera), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::simulated_world

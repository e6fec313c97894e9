// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/camera_model.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "example_lenses.hpp"

namespace panvo::vision {
namespace {

using std::numbers::pi;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kDegree = pi / 180.0;

LensCamera plumb_bob() { return test::example(LensModel::kPlumbBob); }
LensCamera fisheye() { return test::example(LensModel::kEquidistant); }
LensCamera mirror() { return test::example(LensModel::kMei); }
LensCamera wide_mei() { return {{900, 905, 640, 480, 1280, 960}, LensModel::kMei, {-0.05, 0.02, 0.0, 0.0003, 0.8}}; }

std::string refusal(const LensCamera& camera, double field_of_view_rad = 0.0) {
  try {
    const CameraModel model(camera, field_of_view_rad);
    return "accepted up to " + std::to_string(model.widest_rad() / kDegree) + " degrees";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

class AnyLens : public ::testing::TestWithParam<LensCamera> {};

TEST_P(AnyLens, TakesEveryPixelThatItShowsBackWithinAMillionth) {
  const CameraModel model(GetParam());
  const auto& size = GetParam().pinhole;
  int seen = 0;
  double worst_px = 0.0;
  for (int v = 0; v < size.height; v += 7) {
    for (int u = 0; u < size.width; u += 7) {
      const auto direction = model.unproject({u, v});
      if (!direction) continue;
      ++seen;
      EXPECT_NEAR(direction->norm(), 1.0, 1e-12);
      const auto pixel = model.project(3.0 * *direction);
      ASSERT_TRUE(pixel) << u << " " << v;
      worst_px = std::max(worst_px, (*pixel - Eigen::Vector2d(u, v)).norm());
    }
  }
  EXPECT_LT(worst_px, 1e-6);
  EXPECT_GT(seen, 0.7 * (size.width / 7) * (size.height / 7));
}

TEST_P(AnyLens, TakesEveryDirectionThatItSeesBack) {
  const CameraModel model(GetParam());
  for (double theta = 0.0; theta < model.widest_rad(); theta += 0.05) {
    for (double around = 0.0; around < 2.0 * pi; around += 0.7) {
      const Eigen::Vector3d direction(std::sin(theta) * std::cos(around), std::sin(theta) * std::sin(around),
                                      std::cos(theta));
      const auto pixel = model.project(direction);
      ASSERT_TRUE(pixel);
      const auto back = model.unproject(*pixel);
      ASSERT_TRUE(back) << theta / kDegree << " degrees";
      EXPECT_LT((*back - direction).norm(), 1e-8) << theta / kDegree << " degrees";
    }
  }
}

TEST_P(AnyLens, SeesNothingBeyondItsWidestAngle) {
  const CameraModel model(GetParam(), 60.0 * kDegree);
  EXPECT_TRUE(model.project({std::sin(29.9 * kDegree), 0.0, std::cos(29.9 * kDegree)}));
  EXPECT_FALSE(model.project({std::sin(30.1 * kDegree), 0.0, std::cos(30.1 * kDegree)}));
  EXPECT_FALSE(
      model.unproject(*CameraModel(GetParam()).project({0.0, -std::sin(30.1 * kDegree), std::cos(30.1 * kDegree)})));
  EXPECT_FALSE(model.project({0.0, 0.0, -1.0}));
  EXPECT_FALSE(model.project(Eigen::Vector3d::Zero()));
}

INSTANTIATE_TEST_SUITE_P(Lenses, AnyLens, ::testing::ValuesIn(test::example_lenses()),
                         [](const auto& lens) { return std::string(ros_name(lens.param.model)); });
INSTANTIATE_TEST_SUITE_P(WideMei, AnyLens, ::testing::Values(wide_mei()));

/// [Mei2007, section 2]: projection onto the unit sphere, then from a point xi above its centre.
TEST(CameraModel, ProjectsThroughMeisSphere) {
  LensCamera camera = mirror();
  camera.distortion = {0.0, 0.0, 0.0, 0.0, 1.2};
  const auto pixel = CameraModel(camera).project({2.0, -1.0, -0.5});
  ASSERT_TRUE(pixel);
  const double length = std::sqrt(4.0 + 1.0 + 0.25);
  EXPECT_NEAR(pixel->x(), 380.0 * (2.0 / length) / (-0.5 / length + 1.2) + 512.0, 1e-9);
  EXPECT_NEAR(pixel->y(), 381.0 * (-1.0 / length) / (-0.5 / length + 1.2) + 515.0, 1e-9);
}

TEST(CameraModel, IsAPinholeWhereMeisXiIsZero) {
  LensCamera mei = plumb_bob();
  mei.model = LensModel::kMei;
  mei.distortion[4] = 0.0;  // xi; k3 of the perspective lens
  LensCamera perspective = mei;
  perspective.model = LensModel::kPlumbBob;
  const Eigen::Vector3d point(0.4, -0.3, 1.2);
  EXPECT_LT((*CameraModel(mei).project(point) - *CameraModel(perspective).project(point)).norm(), 1e-9);
}

TEST(CameraModel, RefusesADistortionThatFoldsTheImageOver) {
  LensCamera camera = plumb_bob();
  camera.distortion = {-0.9};  // the radius is largest at 0.61, the border at 0.8
  EXPECT_THAT(refusal(camera), AllOf(HasSubstr("not invertible beyond 31.3"), HasSubstr("calibrate")));
  camera = fisheye();
  camera.distortion = {-0.2};  // largest at 1.29 rad, where the image ends at 1.86
  EXPECT_THAT(refusal(camera), HasSubstr("not invertible beyond 73.9"));
  EXPECT_THAT(refusal(camera, 180.0 * kDegree), AllOf(HasSubstr("not invertible"), HasSubstr("180 degrees")));
  EXPECT_THAT(refusal(camera, 140.0 * kDegree), HasSubstr("accepted up to 70.0"));
}

TEST(CameraModel, RefusesWhatNoLensIs) {
  EXPECT_THAT(refusal(plumb_bob(), 185.0 * kDegree), AllOf(HasSubstr("185 degrees"), HasSubstr("plumb_bob")));
  EXPECT_THAT(refusal(fisheye(), 361.0 * kDegree), HasSubstr("361 degrees"));
  LensCamera camera = fisheye();
  camera.pinhole.fy = 0.0;
  EXPECT_THAT(refusal(camera), HasSubstr("focal lengths"));
  camera = fisheye();
  camera.pinhole.height = 0;
  EXPECT_THAT(refusal(camera), HasSubstr("1088 x 0 px"));
  camera = mirror();
  camera.distortion[4] = -0.5;
  EXPECT_THAT(refusal(camera), HasSubstr("xi = -0.5"));
}

}  // namespace
}  // namespace panvo::vision

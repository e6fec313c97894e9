// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/epipolar_misalignment.hpp"

#include <gtest/gtest.h>

#include <random>

#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::vision {
namespace {

using Parts = EpipolarMisalignment::Parts;

const PinholeCamera kCamera{400.0, 400.0, 320.0, 240.0, 640, 480};
const Parts kParts = (Parts() << -1.3, 4e-4, 3e-5, -5e-4, 1e-3, 2e-3).finished();

/// Pixel of a point in a right camera with these errors, given its pixel in an aligned camera.
Eigen::Vector2d seen(const Parts& parts, const Eigen::Vector2d& ideal_pixel) {
  const Eigen::Matrix3d turned_from_aligned = so3_exp(-parts.segment<3>(1));
  const Eigen::Vector3d ray = turned_from_aligned * kCamera.unproject(ideal_pixel);
  LensCamera camera{kCamera, LensModel::kPlumbBob, {parts(5)}};
  camera.pinhole.fx *= 1.0 + parts(4);
  camera.pinhole.fy *= 1.0 + parts(4);
  camera.pinhole.cy += parts(0);
  return CameraModel(camera).project(ray).value();
}

Eigen::Vector2d random_pixel(std::mt19937& random) {
  std::uniform_real_distribution<double> u(20.0, 620.0), v(20.0, 460.0);
  const double column = u(random);
  return {column, v(random)};
}

TEST(EpipolarMisalignment, ShiftsPixelsAsTheCameraWithItsErrorsDoes) {
  std::mt19937 random(1);
  for (int part = 0; part < 6; ++part) {
    const Parts parts = kParts.cwiseProduct(Parts::Unit(part));
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d pixel = random_pixel(random);
      const Eigen::Vector2d difference = seen(parts, pixel) - pixel - EpipolarMisalignment{parts}.shift(kCamera, pixel);
      EXPECT_NEAR(difference.y(), 0.0, 0.005) << "part " << part;
      if (part == 2) continue;  // rotation about Y: no column shift
      EXPECT_NEAR(difference.x(), 0.0, 0.005) << "part " << part;
    }
  }
}

TEST(EpipolarMisalignment, IsAsLargeAsWhereRowsAreFarthestOff) {
  const Parts roll = 1e-3 * Parts::Unit(3);
  EXPECT_NEAR(EpipolarMisalignment{roll}.max_row_shift_px(kCamera), 0.32, 1e-9);  // 320 px from the centre
}

TEST(EpipolarCalibration, FindsTheErrorsOfAMisalignedCamera) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise_px(0.0, 0.2);
  EpipolarCalibration calibration(kCamera);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d pixel = random_pixel(random);
    const double wrong_px = i % 20 == 0 ? 1.5 : 0.0;  // one mismatch in twenty
    calibration.add(pixel, seen(kParts, pixel).y() - pixel.y() + noise_px(random) + wrong_px, 0.2);
    if (i % 50 == 0) calibration.settle();
  }
  calibration.settle();
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d pixel = random_pixel(random);
    const Eigen::Vector2d left_over_px = seen(kParts, pixel) - pixel - calibration.misalignment().shift(kCamera, pixel);
    EXPECT_NEAR(left_over_px.y(), 0.0, 0.03);
    EXPECT_NEAR(left_over_px.x(), -kCamera.fx * kParts(2), 0.05);
  }
}

TEST(EpipolarCalibration, FollowsWhatChanges) {
  std::mt19937 random(3);
  EpipolarCalibration calibration(kCamera);
  for (const double row_px : {0.0, 0.6}) {
    for (int i = 0; i < 100000; ++i) {
      calibration.add(random_pixel(random), row_px, 0.2);
      if (i % 50 == 0) calibration.settle();
    }
    EXPECT_NEAR(calibration.misalignment().shift(kCamera, {400.0, 300.0}).y(), row_px, 0.02);
  }
}

TEST(EpipolarCalibration, TakesRowsThatNoAgedCalibrationHasForRowsAlone) {
  std::mt19937 random(4);
  EpipolarCalibration calibration(kCamera);
  const Parts far_off = 8e-3 * Parts::Unit(2);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d pixel = random_pixel(random);
    calibration.add(pixel, EpipolarMisalignment::row_by_parts(kCamera, pixel).dot(far_off), 0.2);
    if (i % 50 == 0) calibration.settle();
  }
  const Eigen::Vector2d pixel(600.0, 420.0), shift = calibration.misalignment().shift(kCamera, pixel);
  EXPECT_NEAR(shift.y(), EpipolarMisalignment::row_by_parts(kCamera, pixel).dot(far_off), 0.05);
  EXPECT_EQ(shift.x(), 0.0);
}

TEST(EpipolarCalibration, KnowsNothingOfWhatItHasNotSeen) {
  EpipolarCalibration calibration(kCamera);
  calibration.settle();
  EXPECT_EQ(calibration.misalignment().shift(kCamera, {100.0, 400.0}), Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace panvo::vision

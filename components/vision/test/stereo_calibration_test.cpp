// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/stereo_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/rectification.hpp"

namespace panvo::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

StereoCalibration toed_in_calibration() {
  StereoCalibration calibration;
  calibration.left = {{262.3, 263.5, 156.2, 123.7, 320, 240}, LensModel::kPlumbBob, {-0.36, 0.17, 0.001, -0.002, 0.0}};
  calibration.right = {{263.2, 264.3, 159.2, 122.9, 320, 240}, LensModel::kPlumbBob, {-0.35, 0.16, 0.0, 0.001, 0.0}};
  calibration.right_from_left.linear() = so3_exp({0.003, -0.0075, 0.002});
  calibration.right_from_left.translation() = Eigen::Vector3d(-0.12, 0.001, -0.001);
  return calibration;
}

/// Fisheyes with a field of view of 190 degrees.
StereoCalibration fisheyes() {
  StereoCalibration calibration = toed_in_calibration();
  calibration.left = {{100.3, 100.5, 158.2, 121.7, 320, 240}, LensModel::kEquidistant, {0.01, -0.003, 0.001, 0.0}};
  calibration.right = {{101.2, 101.3, 160.2, 119.9, 320, 240}, LensModel::kEquidistant, {0.02, -0.004, 0.0, 0.0}};
  return calibration;
}

StereoCalibration rational() {
  StereoCalibration calibration = toed_in_calibration();
  calibration.left.model = calibration.right.model = LensModel::kRational;
  calibration.left.distortion = calibration.right.distortion = {0.1, 0.05, 0.001, -0.001, 0.01, 0.4, 0.1, 0.02};
  return calibration;
}

void expect_aligned(const StereoCalibration& raw) {
  const RectifiedStereo stereo = rectify(raw);
  EXPECT_THAT(validate(stereo), IsEmpty());
  EXPECT_NEAR(stereo.baseline_m, raw.right_from_left.translation().norm(), 1e-9);
  for (const Eigen::Vector3d& point_in_left : {Eigen::Vector3d(0.3, -0.2, 2.0), Eigen::Vector3d(-1.0, 0.4, 7.0)}) {
    const Eigen::Vector3d point_in_rectified_left = stereo.rectified_left_from_left * point_in_left;
    const Eigen::Vector2d left = stereo.camera.project(point_in_rectified_left);
    const Eigen::Vector2d right =
        stereo.camera.project(stereo.rectified_right_from_right * (raw.right_from_left * point_in_left));
    EXPECT_NEAR(left.y(), right.y(), 1e-6);
    EXPECT_NEAR(left.x() - right.x(), stereo.camera.fx * stereo.baseline_m / point_in_rectified_left.z(), 1e-6);
  }
}

TEST(Rectify, PutsAPointOnTheSameRowWithTheDisparityOfItsDepthWhateverTheLenses) {
  for (const auto& raw : {toed_in_calibration(), fisheyes(), rational()}) {
    SCOPED_TRACE(ros_name(raw.left.model));
    expect_aligned(raw);
  }
}

/// Every rectified pixel has a source in the raw image.
TEST(Rectify, GivesWideLensesAViewThatBothSeeAllOf) {
  for (const auto& raw : {fisheyes(), rational()}) {
    SCOPED_TRACE(ros_name(raw.left.model));
    const RectifiedStereo stereo = rectify(raw);
    const CameraModel left(raw.left), right(raw.right);
    for (const double u : {0.0, 160.0, 319.0}) {
      for (const double v : {0.0, 120.0, 239.0}) {
        const Eigen::Vector3d ray = stereo.camera.unproject({u, v});
        const auto in_left = left.project(stereo.rectified_left_from_left.transpose() * ray);
        const auto in_right = right.project(stereo.rectified_right_from_right.transpose() * ray);
        ASSERT_TRUE(in_left && in_right) << u << ", " << v;
        EXPECT_TRUE(raw.left.pinhole.contains(*in_left)) << u << ", " << v;
        EXPECT_TRUE(raw.right.pinhole.contains(*in_right)) << u << ", " << v;
      }
    }
  }
  // A 190 degree fisheye fills the widest view allowed for a perspective image.
  const auto camera = rectify(fisheyes()).camera;
  EXPECT_NEAR(2.0 * std::atan(0.5 * 319.0 / camera.fx), 1.92, 0.02);
}

TEST(Rectify, LeavesARectifiedPairAsItIs) {
  StereoCalibration calibration;
  calibration.left.pinhole = calibration.right.pinhole = {400, 410, 321, 239, 640, 480};
  calibration.right_from_left.translation().x() = -0.12;
  const auto stereo = rectify(calibration);
  EXPECT_TRUE(is_rectified(calibration));
  EXPECT_EQ(stereo.camera.fy, 410.0);
  EXPECT_EQ(stereo.baseline_m, 0.12);
  EXPECT_TRUE(stereo.rectified_left_from_left.isIdentity(0.0));
  calibration.left.model = calibration.right.model = LensModel::kEquidistant;
  EXPECT_FALSE(is_rectified(calibration)) << "a fisheye is not perspective even without distortion";
}

TEST(Rectify, SaysWhichLensCannotBe) {
  auto calibration = fisheyes();
  calibration.right.distortion[0] = -3.0;
  try {
    rectify(calibration);
    FAIL() << "a lens whose distortion is not invertible";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("right camera has"));
  }
}

TEST(Rectify, NamesEveryProblemOfACalibration) {
  StereoCalibration calibration = toed_in_calibration();
  calibration.right_from_left.translation().setZero();
  calibration.left.pinhole.fx = std::numeric_limits<double>::quiet_NaN();
  calibration.right.pinhole.width = 640;
  EXPECT_THAT(validate(calibration), SizeIs(3));
  EXPECT_THROW(rectify(calibration), std::invalid_argument);
}

TEST(Validate, FindsExchangedCamerasByTheSignOfTheBaseline) {
  StereoCalibration calibration = toed_in_calibration();
  calibration.right_from_left = calibration.right_from_left.inverse();
  const auto problems = validate(calibration);
  ASSERT_THAT(problems, SizeIs(1));
  EXPECT_THAT(problems.front(), HasSubstr("swapped"));
}

TEST(RectificationMap, BringsADistortedPointToItsRectifiedPixel) {
  const StereoCalibration raw = toed_in_calibration();
  const RectifiedStereo stereo = rectify(raw);
  const Eigen::Vector3d point_in_left(0.35, 0.25, 2.0);
  const Eigen::Vector2d raw_pixel = CameraModel(raw.left).project(point_in_left).value();
  // The centroid of a smooth blob drawn through the lens must lie at its rectified projection.
  cv::Mat image(240, 320, CV_32F);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      image.at<float>(v, u) =
          static_cast<float>(255.0 * std::exp(-(Eigen::Vector2d(u, v) - raw_pixel).squaredNorm() / 8.0));
    }
  }
  cv::Mat rectified;
  RectificationMap(raw.left, stereo.rectified_left_from_left, stereo.camera).apply(image, rectified);
  const cv::Moments moments = cv::moments(rectified);
  const Eigen::Vector2d expected = stereo.camera.project(stereo.rectified_left_from_left * point_in_left);
  EXPECT_NEAR(moments.m10 / moments.m00, expected.x(), 0.1);
  EXPECT_NEAR(moments.m01 / moments.m00, expected.y(), 0.1);
}

TEST(RectificationMap, RefusesAnImageOfAnotherSize) {
  const StereoCalibration raw = toed_in_calibration();
  const RectifiedStereo stereo = rectify(raw);
  const RectificationMap map(raw.left, stereo.rectified_left_from_left, stereo.camera);
  cv::Mat rectified;
  EXPECT_THROW(map.apply(cv::Mat::zeros(480, 640, CV_8U), rectified), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/rectification.hpp"

namespace panvo::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

StereoCalibration toed_in_calibration() {
  StereoCalibration calibration;
  calibration.left = {{262.3, 263.5, 156.2, 123.7, 320, 240}, {-0.36, 0.17, 0.001, -0.002, 0.0}};
  calibration.right = {{263.2, 264.3, 159.2, 122.9, 320, 240}, {-0.35, 0.16, 0.0, 0.001, 0.0}};
  calibration.right_from_left.linear() = so3_exp({0.003, -0.0075, 0.002});
  calibration.right_from_left.translation() = Eigen::Vector3d(-0.12, 0.001, -0.001);
  return calibration;
}

TEST(PinholeCamera, ProjectsWhatItUnprojects) {
  const PinholeCamera camera{400.0, 410.0, 320.0, 240.0, 640, 480};
  const Eigen::Vector2d pixel(17.25, 401.5);
  EXPECT_LT((camera.project(7.0 * camera.unproject(pixel)) - pixel).norm(), 1e-12);
}

TEST(PinholeCamera, ContainsItsCornersButNotBeyond) {
  const PinholeCamera camera{400.0, 410.0, 320.0, 240.0, 640, 480};
  EXPECT_TRUE(camera.contains({0.0, 0.0}));
  EXPECT_TRUE(camera.contains({639.0, 479.0}));
  EXPECT_FALSE(camera.contains({639.1, 100.0}));
  EXPECT_FALSE(camera.contains({4.0, 100.0}, 5.0));
}

TEST(Rectify, PutsAPointOnTheSameRowWithTheDisparityOfItsDepth) {
  const StereoCalibration raw = toed_in_calibration();
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
  EXPECT_THAT(problems.front(), HasSubstr("exchanged"));
}

TEST(Validate, RefusesABaselineThatIsNoPositiveNumber) {
  for (const double baseline_m : {0.0, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(validate(RectifiedStereo{{400, 400, 320, 240, 640, 480}, baseline_m}), SizeIs(1));
  }
}

TEST(RectificationMap, BringsADistortedPointToItsRectifiedPixel) {
  const StereoCalibration raw = toed_in_calibration();
  const RectifiedStereo stereo = rectify(raw);
  const Eigen::Vector3d point_in_left(0.35, 0.25, 2.0);
  const Eigen::Vector2d raw_pixel = raw.left.project(point_in_left);
  // A smooth blob drawn where the lens puts it: its centre of mass must come out at the rectified projection.
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

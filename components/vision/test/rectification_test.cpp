// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/rectification.hpp"

#include <gmock/gmock.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "panvo/vision/camera_model.hpp"
#include "panvo/vision/pose.hpp"
#include "textured_image.hpp"

namespace panvo::vision {
namespace {

const PinholeCamera kRectified{250, 250, 160, 120, 320, 240};

cv::Mat noise(int type) {
  cv::Mat image(240, 320, type);
  cv::RNG(11).fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

/// Rotated so far that part of the rectified image lies outside the raw image.
TEST(RectificationMap, GivesThePixelsOfOpenCvsRemap) {
  const LensCamera raw{{262.3, 263.5, 156.2, 123.7, 320, 240}, LensModel::kPlumbBob, {-0.36, 0.17, 0.001, -0.002, 0.0}};
  const Eigen::Matrix3d rotation = so3_exp({0.1, -0.15, 0.03});
  const RectificationMap map(raw, rotation, kRectified);
  cv::Mat coordinates, fractions;
  const auto& r = rotation;
  cv::initUndistortRectifyMap(
      cv::Matx33d(262.3, 0, 156.2, 0, 263.5, 123.7, 0, 0, 1), cv::Matx<double, 1, 5>(raw.distortion.data()),
      cv::Matx33d(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
      cv::Matx33d(250, 0, 160, 0, 250, 120, 0, 0, 1), {320, 240}, CV_16SC2, coordinates, fractions);
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1}) {
    const cv::Mat image = noise(type);
    cv::Mat expected, found;
    cv::remap(image, expected, coordinates, fractions, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    map.apply(image, found);
    ASSERT_EQ(found.type(), type);
    EXPECT_EQ(cv::norm(expected, found, cv::NORM_INF), 0.0) << cv::typeToString(type);
  }
}

TEST(RectificationMap, ReadsAnImageWithGapsBetweenItsRows) {
  const LensCamera raw{{262.3, 263.5, 156.2, 123.7, 320, 240}, LensModel::kPlumbBob, {-0.3, 0.1, 0.0, 0.0, 0.0}};
  const RectificationMap map(raw, Eigen::Matrix3d::Identity(), kRectified);
  const cv::Mat image = noise(CV_8UC3);
  cv::Mat wide(240, 333, CV_8UC3);
  image.copyTo(wide.colRange(5, 325));
  cv::Mat expected, found;
  map.apply(image, expected);
  map.apply(wide.colRange(5, 325), found);
  EXPECT_EQ(cv::norm(expected, found, cv::NORM_INF), 0.0);
}

/// Rectifying an image drawn through the lens gives the image of a pinhole camera.
void expect_straight(const LensCamera& raw) {
  const Eigen::Matrix3d rotation = so3_exp({0.03, 0.05, -0.02});
  const CameraModel model(raw);
  const auto place = [](const Eigen::Vector3d& in_rectified) {
    return cv::Point2d(15.0 * in_rectified.x() / in_rectified.z(), 15.0 * in_rectified.y() / in_rectified.z());
  };
  const cv::Mat image = draw({raw.pinhole.width, raw.pinhole.height}, [&](double u, double v) {
    const auto direction = model.unproject({u, v});
    const Eigen::Vector3d in_rectified = direction ? Eigen::Vector3d(rotation * *direction) : Eigen::Vector3d::UnitZ();
    return in_rectified.z() > 0.1 ? place(in_rectified) : cv::Point2d();
  });
  const cv::Mat expected = draw({kRectified.width, kRectified.height}, [&](double u, double v) {
    return place(kRectified.unproject({u, v}));
  });
  cv::Mat rectified;
  RectificationMap(raw, rotation, kRectified).apply(image, rectified);
  EXPECT_LT(cv::norm(expected, rectified, cv::NORM_L1) / static_cast<double>(expected.total()), 0.6);
  EXPECT_LT(cv::norm(expected, rectified, cv::NORM_INF), 6.0);
}

TEST(RectificationMap, StraightensAFisheye) {
  expect_straight({{150, 151, 318, 243, 640, 480}, LensModel::kEquidistant, {-0.012, 0.004, -0.002, 0.0002}});
}

TEST(RectificationMap, StraightensARationalLens) {
  expect_straight(
      {{330, 331, 322, 238, 640, 480}, LensModel::kRational, {0.9, 0.2, 0.0004, -0.0003, 0.004, 1.25, 0.45, 0.03}});
}

TEST(RectificationMap, StraightensAnOmnidirectionalCamera) {
  expect_straight({{380, 381, 322, 238, 640, 480}, LensModel::kMei, {-0.1, 0.05, 0.0005, -0.0004, 1.2}});
}

/// The image ends 70 px left of its centre, at 27 degrees: column 34 of the rectified image.
TEST(RectificationMap, IsBlackWhereTheLensSeesNothing) {
  const LensCamera raw{{150, 150, 70, 120, 140, 240}, LensModel::kEquidistant};
  cv::Mat rectified;
  RectificationMap(raw, Eigen::Matrix3d::Identity(), kRectified)
      .apply(cv::Mat(240, 140, CV_8UC1, cv::Scalar(90)), rectified);
  EXPECT_EQ(rectified.at<uchar>(120, 38), 90);
  EXPECT_EQ(rectified.at<uchar>(120, 30), 0);
  EXPECT_EQ(cv::countNonZero(rectified.col(0)), 0);
}

TEST(RectificationMap, RefusesALensThatFoldsTheImageOver) {
  const LensCamera raw{{290, 291, 540, 545, 1088, 1088}, LensModel::kEquidistant, {-0.2}};
  EXPECT_THROW(RectificationMap(raw, Eigen::Matrix3d::Identity(), kRectified), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::vision

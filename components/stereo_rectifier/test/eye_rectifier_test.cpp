// SPDX-License-Identifier: Apache-2.0
#include "eye_rectifier.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "panvo/conversions/image.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::stereo_rectifier {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kEyeWidth = 320, kEyeHeight = 240;

/// A realistic pair: wide lenses, rotated by a few degrees relative to each other, not exactly side by side.
vision::StereoCalibration raw_pair() {
  vision::StereoCalibration pair;
  pair.left.pinhole = {262, 263, 156, 124, kEyeWidth, kEyeHeight};
  pair.right.pinhole = {264, 265, 160, 121, kEyeWidth, kEyeHeight};
  pair.left.distortion = {-0.36, 0.17, 0.001, -0.0005, 0.0};
  pair.right.distortion = {-0.35, 0.16, -0.0008, 0.0004, 0.0};
  pair.right_from_left.linear() =
      Eigen::AngleAxisd(0.04, Eigen::Vector3d(0.5, 0.3, 0.8).normalized()).toRotationMatrix();
  pair.right_from_left.translation() = Eigen::Vector3d(-0.12, 0.006, -0.004);
  return pair;
}

struct Infos {
  sensor_msgs::msg::CameraInfo left, right;
};

Infos infos(const vision::StereoCalibration& pair, const vision::RectifiedStereo& rectified) {
  return {conversions::to_camera_info(conversions::left_camera(pair, rectified), 0, "left"),
          conversions::to_camera_info(conversions::right_camera(pair, rectified), 0, "right")};
}

/// A pair that needs no rectification.
Infos rectified_infos() {
  vision::StereoCalibration pair;
  pair.left.pinhole = pair.right.pinhole = {262, 262, 160, 120, kEyeWidth, kEyeHeight};
  vision::RectifiedStereo rectified;
  rectified.camera = pair.left.pinhole;
  rectified.baseline_m = 0.12;
  return infos(pair, rectified);
}

EyeRectifier rectifier_of(const sensor_msgs::msg::CameraInfo& info, Output output = Output::kMono8) {
  EyeRectifier rectifier(output);
  rectifier.add_info(info);
  return rectifier;
}

/// Points spread over the view of the left camera, 1 to 6 m away.
std::vector<Eigen::Vector3d> points_in_left() {
  std::vector<Eigen::Vector3d> points;
  for (int row = -2; row <= 2; ++row) {
    for (int column = -2; column <= 2; ++column) {
      const double z = 1.0 + 0.2 * ((row + 2) * 5 + column + 2);
      points.emplace_back(z * 0.17 * column + 0.06, z * 0.14 * row, z);
    }
  }
  return points;
}

/// An image of bright spots at these pixels.
std::shared_ptr<const sensor_msgs::msg::Image> spots(const std::vector<Eigen::Vector2d>& pixels) {
  const auto image = conversions::make_image(7, "left", "mono8", kEyeWidth, kEyeHeight);
  cv::Mat view = conversions::pixels(*image);
  for (const auto& pixel : pixels) {
    for (int v = static_cast<int>(pixel.y()) - 7; v <= static_cast<int>(pixel.y()) + 8; ++v) {
      for (int u = static_cast<int>(pixel.x()) - 7; u <= static_cast<int>(pixel.x()) + 8; ++u) {
        if (u < 0 || v < 0 || u >= kEyeWidth || v >= kEyeHeight) continue;
        const double squared = (u - pixel.x()) * (u - pixel.x()) + (v - pixel.y()) * (v - pixel.y());
        view.at<std::uint8_t>(v, u) =
            cv::saturate_cast<std::uint8_t>(view.at<std::uint8_t>(v, u) + 220.0 * std::exp(-squared / 8.0));
      }
    }
  }
  return image;
}

Eigen::Vector2d centre_of_spot(const cv::Mat& image, const Eigen::Vector2d& near) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (int v = static_cast<int>(std::lround(near.y())) - 7; v <= std::lround(near.y()) + 7; ++v) {
    for (int u = static_cast<int>(std::lround(near.x())) - 7; u <= std::lround(near.x()) + 7; ++u) {
      sum += image.at<std::uint8_t>(v, u) * Eigen::Vector2d(u, v);
      weight += image.at<std::uint8_t>(v, u);
    }
  }
  return sum / weight;
}

TEST(EyeRectifier, AlignsTheRowsOfAPairToATenthOfAPixel) {
  const auto pair = raw_pair();
  const auto stereo = vision::rectify(pair);
  const auto [left_info, right_info] = infos(pair, stereo);
  auto left_rectifier = rectifier_of(left_info);
  auto right_rectifier = rectifier_of(right_info);
  const vision::CameraModel left_model(pair.left), right_model(pair.right);

  std::vector<Eigen::Vector2d> left_pixels, right_pixels;
  for (const auto& point : points_in_left()) {
    left_pixels.push_back(*left_model.project(point));
    right_pixels.push_back(*right_model.project(pair.right_from_left * point));
  }
  const auto left = left_rectifier.rectify(spots(left_pixels));
  const auto right = right_rectifier.rectify(spots(right_pixels));
  ASSERT_TRUE(left && right);
  const auto left_view = conversions::view(**left);
  const auto right_view = conversions::view(**right);

  int seen = 0;
  double max_raw_row_error_px = 0.0;
  for (std::size_t i = 0; i < points_in_left().size(); ++i) {
    const Eigen::Vector3d point_in_rectified = stereo.rectified_left_from_left * points_in_left()[i];
    const auto expected_left = stereo.camera.project(point_in_rectified);
    const double disparity_px = stereo.camera.fx * stereo.baseline_m / point_in_rectified.z();
    const Eigen::Vector2d expected_right = expected_left - Eigen::Vector2d(disparity_px, 0.0);
    if (!stereo.camera.contains(expected_left, 9.0) || !stereo.camera.contains(expected_right, 9.0)) continue;
    const auto left_spot = centre_of_spot(*left_view, expected_left);
    const auto right_spot = centre_of_spot(*right_view, expected_right);
    EXPECT_NEAR(left_spot.y(), right_spot.y(), 0.1) << "point " << i;
    EXPECT_NEAR(left_spot.x() - right_spot.x(), disparity_px, 0.15) << "point " << i;
    max_raw_row_error_px = std::max(max_raw_row_error_px, std::abs(left_pixels[i].y() - right_pixels[i].y()));
    ++seen;
  }
  EXPECT_GE(seen, 15);
  EXPECT_GT(max_raw_row_error_px, 5.0) << "the raw pair must need rectification";
}

/// The same pair with fisheye lenses.
TEST(EyeRectifier, AlignsTheRowsOfAFisheyePair) {
  const auto pair = raw_pair();
  const auto stereo = vision::rectify(pair);
  auto left_camera = conversions::left_camera(pair, stereo);
  auto right_camera = conversions::right_camera(pair, stereo);
  left_camera.raw = {pair.left.pinhole, vision::LensModel::kEquidistant, {-0.02, 0.004, -0.001, 0.0002}};
  right_camera.raw = {pair.right.pinhole, vision::LensModel::kEquidistant, {-0.018, 0.003, -0.001, 0.0001}};
  const vision::CameraModel left_model(left_camera.raw), right_model(right_camera.raw);
  auto left_rectifier = rectifier_of(conversions::to_camera_info(left_camera, 0, "left"));
  auto right_rectifier = rectifier_of(conversions::to_camera_info(right_camera, 0, "right"));
  std::vector<Eigen::Vector2d> left_pixels, right_pixels;
  for (const auto& point : points_in_left()) {
    left_pixels.push_back(*left_model.project(point));
    right_pixels.push_back(*right_model.project(pair.right_from_left * point));
  }
  const auto left = left_rectifier.rectify(spots(left_pixels));
  const auto right = right_rectifier.rectify(spots(right_pixels));
  ASSERT_TRUE(left && right);
  int seen = 0;
  for (const auto& point : points_in_left()) {
    const Eigen::Vector3d point_in_rectified = stereo.rectified_left_from_left * point;
    const auto expected_left = stereo.camera.project(point_in_rectified);
    const double disparity_px = stereo.camera.fx * stereo.baseline_m / point_in_rectified.z();
    const Eigen::Vector2d expected_right = expected_left - Eigen::Vector2d(disparity_px, 0.0);
    if (!stereo.camera.contains(expected_left, 9.0) || !stereo.camera.contains(expected_right, 9.0)) continue;
    const auto left_spot = centre_of_spot(*conversions::view(**left), expected_left);
    const auto right_spot = centre_of_spot(*conversions::view(**right), expected_right);
    EXPECT_NEAR(left_spot.y(), right_spot.y(), 0.15);
    EXPECT_NEAR(left_spot.x() - right_spot.x(), disparity_px, 0.2);
    ++seen;
  }
  EXPECT_GE(seen, 15);
}

TEST(EyeRectifier, RefusesALensThatFoldsTheImageOver) {
  auto info = rectified_infos().left;
  info.d({-0.9, 0.0, 0.0, 0.0, 0.0});
  auto rectifier = rectifier_of(info);
  const auto raw = std::shared_ptr<const sensor_msgs::msg::Image>(
      conversions::make_image(7, "left", "mono8", kEyeWidth, kEyeHeight));
  EXPECT_THAT(rectifier.rectify(raw).reason(), AllOf(HasSubstr("not invertible beyond"), HasSubstr("calibrate")));
}

TEST(EyeRectifier, HandsOnARectifiedImageItself) {
  auto rectifier = rectifier_of(rectified_infos().right);
  const auto raw = std::shared_ptr<const sensor_msgs::msg::Image>(
      conversions::make_image(7, "right", "mono8", kEyeWidth, kEyeHeight));
  EXPECT_EQ(*rectifier.rectify(raw), raw);
}

TEST(EyeRectifier, HandsOnColourOnlyIfAskedTo) {
  const auto raw = conversions::make_image(7, "left", "rgb8", kEyeWidth, kEyeHeight);
  conversions::pixels(*raw).setTo(cv::Scalar(200, 0, 0));
  auto grey = rectifier_of(rectified_infos().left);
  const auto rectified = grey.rectify(raw);
  ASSERT_TRUE(rectified);
  EXPECT_EQ((*rectified)->encoding(), "mono8");
  EXPECT_EQ((*rectified)->data()[100], 60);  // 0.299 * 200
  auto same = rectifier_of(rectified_infos().left, Output::kSame);
  EXPECT_EQ(same.rectify(raw)->get(), raw.get());
}

TEST(EyeRectifier, KeepsStampFrameAndEncoding) {
  const auto pair = raw_pair();
  auto rectifier = rectifier_of(infos(pair, vision::rectify(pair)).left, Output::kSame);
  const auto raw = conversions::make_image(1'700'000'000'123'456'789, "left", "bgr8", kEyeWidth, kEyeHeight);
  const auto rectified = rectifier.rectify(raw);
  ASSERT_TRUE(rectified);
  EXPECT_EQ((*rectified)->header().stamp(), raw->header().stamp());
  EXPECT_EQ((*rectified)->header().frame_id(), "left");
  EXPECT_EQ((*rectified)->encoding(), "bgr8");
}

TEST(EyeRectifier, TellsAChangeOfTheCameraFromANewHeader) {
  auto info = rectified_infos().left;
  EyeRectifier rectifier(Output::kMono8);
  EXPECT_EQ(rectifier.add_info(info), EyeRectifier::Info::kTaken);
  info.header().stamp().sec(5);
  EXPECT_EQ(rectifier.add_info(info), EyeRectifier::Info::kKnown);
  info.k()[2] += 1.0;
  EXPECT_EQ(rectifier.add_info(info), EyeRectifier::Info::kTaken);
}

TEST(EyeRectifier, SaysWhyAnImageCannotBeRectified) {
  const auto image = [](int width, const char* encoding) {
    return std::shared_ptr<sensor_msgs::msg::Image>(conversions::make_image(7, "left", encoding, width, kEyeHeight));
  };
  auto rectifier = rectifier_of(rectified_infos().left);
  EXPECT_THAT(rectifier.rectify(image(64, "mono8")).reason(),
              AllOf(HasSubstr("64 x 240"), HasSubstr("320 x 240"), HasSubstr("calibrate")));
  const auto cut_off = image(kEyeWidth, "mono8");
  cut_off->data().resize(100);
  EXPECT_THAT(rectifier.rectify(cut_off).reason(), HasSubstr("holds 100 bytes"));
  const auto bayer = image(kEyeWidth, "mono8");
  bayer->encoding("bayer_rggb8");
  EXPECT_THAT(rectifier.rectify(bayer).reason(), HasSubstr("bayer_rggb8"));

  auto uncalibrated = rectifier_of(sensor_msgs::msg::CameraInfo());
  EXPECT_THAT(uncalibrated.rectify(image(kEyeWidth, "mono8")).reason(), HasSubstr("not calibrated"));
  EXPECT_THAT(EyeRectifier(Output::kMono8).rectify(image(kEyeWidth, "mono8")).reason(), HasSubstr("no camera_info"));
}

}  // namespace
}  // namespace panvo::stereo_rectifier

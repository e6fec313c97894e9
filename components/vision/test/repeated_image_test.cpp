// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/repeated_image.hpp"

#include <gtest/gtest.h>

namespace panvo::vision {
namespace {

cv::Mat sensor_image(std::uint64_t seed, cv::Size size = {64, 48}, int type = CV_8UC1) {
  cv::Mat image(size, type);
  cv::RNG(seed).fill(image, cv::RNG::NORMAL, 120.0, 2.0);
  return image;
}

/// The fault of the next image of a camera.
std::optional<std::string> fault_of_next(RepeatedImage& camera, const cv::Mat& image) {
  const auto fault = camera.find_fault(image);
  camera.remember(image);
  return fault;
}

TEST(RepeatedImage, FindsAnImageThatIsTheOneBefore) {
  RepeatedImage camera;
  EXPECT_FALSE(fault_of_next(camera, sensor_image(1)));
  EXPECT_EQ(fault_of_next(camera, sensor_image(1)), "repeats its image (frozen)");
  EXPECT_TRUE(fault_of_next(camera, sensor_image(1)));
  EXPECT_FALSE(fault_of_next(camera, sensor_image(2)));
  EXPECT_FALSE(fault_of_next(camera, sensor_image(1))) << "equals the last but one, not the last";
}

TEST(RepeatedImage, TakesTheLeastNoiseForANewImage) {
  RepeatedImage camera;
  cv::Mat image = sensor_image(1);
  camera.remember(image);
  ++image.at<uchar>(40, 63);
  EXPECT_FALSE(fault_of_next(camera, image));
}

TEST(RepeatedImage, ComparesImagesOfOneShapeOnly) {
  RepeatedImage camera;
  EXPECT_FALSE(fault_of_next(camera, cv::Mat()));
  EXPECT_FALSE(fault_of_next(camera, cv::Mat())) << "an empty image has another fault";
  EXPECT_FALSE(fault_of_next(camera, cv::Mat::zeros(48, 64, CV_8UC1)));
  EXPECT_FALSE(fault_of_next(camera, cv::Mat::zeros(48, 64, CV_8UC3)));
  EXPECT_FALSE(fault_of_next(camera, cv::Mat::zeros(49, 64, CV_8UC3)));
  EXPECT_FALSE(fault_of_next(camera, cv::Mat::zeros(49, 65, CV_8UC3)));
}

TEST(RepeatedImage, ReadsAPartOfALargerImage) {
  RepeatedImage camera;
  const cv::Mat large = sensor_image(1, {200, 100}, CV_8UC3);
  EXPECT_FALSE(fault_of_next(camera, large(cv::Rect(10, 10, 64, 48))));
  EXPECT_TRUE(fault_of_next(camera, large(cv::Rect(10, 10, 64, 48)).clone()));
  EXPECT_FALSE(fault_of_next(camera, large(cv::Rect(11, 10, 64, 48))));
}

TEST(RepeatedImage, FindsTwoEyesOfOneCamera) {
  EXPECT_TRUE(are_same(sensor_image(1), sensor_image(1)));
  EXPECT_FALSE(are_same(sensor_image(1), sensor_image(2)));
  EXPECT_FALSE(are_same(sensor_image(1), sensor_image(1, {64, 56})));
  EXPECT_FALSE(are_same(cv::Mat(), cv::Mat()));
}

}  // namespace
}  // namespace panvo::vision

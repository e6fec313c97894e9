// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/passable_region.hpp"

#include <gtest/gtest.h>

#include "road_shapes.hpp"

namespace panvo::landmark_builder {
namespace {

double area_m2(const cv::Mat& mask) { return cv::countNonZero(mask) * kResolution_m * kResolution_m; }

TEST(PassableRegion, IsWhatHangsTogetherWithTheVehicle) {  // [Lu2015 4.1]
  cv::Mat road = star_mask({0.0, 180.0});
  cv::rectangle(road, cv::Rect(10, 10, 40, 40), 255, cv::FILLED);  // a car park separated by grass
  const cv::Mat passable = passable_region(road, middle_pixel(), kResolution_m, {});
  EXPECT_EQ(passable.at<std::uint8_t>(30, 30), 0);
  EXPECT_EQ(passable.at<std::uint8_t>(10, kSide / 2), 255);
  EXPECT_NEAR(area_m2(passable), area_m2(star_mask({0.0, 180.0})), 0.05 * area_m2(passable));
}

TEST(PassableRegion, DropsFootpathsAndFillsMarkings) {
  cv::Mat road = star_mask({0.0, 180.0});
  cv::line(road, middle_pixel(), {0, kSide / 2}, 255, 6);  // 1.5 m wide
  cv::line(road, {kSide / 2, 0}, {kSide / 2, kSide / 2 - 10}, 0, 2);
  const cv::Mat passable = passable_region(road, middle_pixel(), kResolution_m, {});
  EXPECT_EQ(passable.at<std::uint8_t>(kSide / 2, 40), 0);
  EXPECT_EQ(passable.at<std::uint8_t>(30, kSide / 2), 255);
}

TEST(PassableRegion, FillsAParkedCarButNotATrafficIsland) {
  cv::Mat road(kSide, kSide, CV_8UC1, cv::Scalar(255));
  cv::rectangle(road, cv::Rect(20, 20, 16, 7), 0, cv::FILLED);     // 4 m x 1.75 m
  cv::rectangle(road, cv::Rect(150, 150, 40, 40), 0, cv::FILLED);  // 10 m x 10 m
  const cv::Mat passable = passable_region(road, middle_pixel(), kResolution_m, {});
  EXPECT_EQ(passable.at<std::uint8_t>(23, 28), 255);
  EXPECT_EQ(passable.at<std::uint8_t>(170, 170), 0);
}

TEST(PassableRegion, IsEmptyWhereTheVehicleStandsOnNone) {
  EXPECT_EQ(cv::countNonZero(passable_region(empty_mask(), middle_pixel(), kResolution_m, {})), 0);
  EXPECT_EQ(cv::countNonZero(passable_region(star_mask({0.0}), {-5, 3}, kResolution_m, {})), 0);
  EXPECT_THROW(passable_region(cv::Mat(), {0, 0}, kResolution_m, {}), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::landmark_builder

// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/point_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "painted_panorama.hpp"

namespace panvo::panoramic_compass {
namespace {

TEST(PointField, FindsItsPointsBetweenPixelsAndOverTheSeam) {
  const cv::Mat band = paint_panorama().rowRange(150, 294);
  const cv::Mat moved = turned_left(band, 7.3);
  PointField field(RoundBand(band), {});
  ASSERT_GT(field.size(), 100U);
  const auto found = field.follow(RoundBand(moved), [](double) { return 5.0; });
  ASSERT_GT(found.size(), field.size() * 8 / 10);
  double squares = 0.0;
  for (const FoundPoint& point : found) {
    const double shift = std::remainder(point.now.x() - point.then.x(), kColumns);
    squares += std::pow(shift - 7.3, 2);
    EXPECT_GE(point.now.x(), 0.0);
    EXPECT_LT(point.now.x(), kColumns);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(found.size())), 0.15);
}

TEST(PointField, HasNoPointsInTheSky) {
  cv::Mat clouds(144, kColumns, CV_8UC1, cv::Scalar(200));
  cv::RNG random(11);
  for (int i = 0; i < 150; ++i) {
    cv::circle(clouds, cv::Point(random.uniform(20, kColumns - 20), random.uniform(0, 144)), 8, cv::Scalar(250), -1);
  }
  EXPECT_GT(PointField(RoundBand(clouds), {}).size(), 50U);
  EXPECT_EQ(PointField(RoundBand(clouds, 150.0), {}).size(), 0U);
}

TEST(PointField, GivesUpWhatIsNotFoundThreeTimesRunning) {
  const cv::Mat band = paint_panorama().rowRange(150, 294), other = paint_panorama(2).rowRange(150, 294);
  PointField field(RoundBand(band), {});
  const auto begun_with = field.size();
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(field.follow(RoundBand(other), [](double) { return 0.0; }).size(), begun_with / 4);
  }
  EXPECT_LT(field.size(), begun_with / 2);
}

}  // namespace
}  // namespace panvo::panoramic_compass

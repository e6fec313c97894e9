// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/radon_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "road_shapes.hpp"

namespace panvo::landmark_builder {
namespace {

using ::testing::SizeIs;

std::vector<RadonPeak> peaks_of(const cv::Mat& mask) {
  return local_maxima(radon_transform(mask, kResolution_m, 90), 0.6, 25.0 * kDegree);
}

TEST(RadonTransform, OfEveryDirectionSumsToTheRoadsArea) {  // [Lu2015 4.1]
  const cv::Mat mask = star_mask({0.0, 90.0, 180.0});
  const RadonField field = radon_transform(mask, kResolution_m, 90);
  const double area_m2 = cv::countNonZero(mask) * kResolution_m * kResolution_m;
  for (int direction = 0; direction < 90; ++direction) {
    EXPECT_NEAR(cv::sum(field.lengths_m.row(direction))[0] * field.offset_step_m, area_m2,
                0.04 * area_m2);  // every second pixel is counted
  }
}

TEST(RadonTransform, HasOneMaximumForAStraightRoadWhereItRuns) {
  const auto peaks = peaks_of(star_mask({30.0, 210.0}));
  ASSERT_THAT(peaks, SizeIs(1));
  EXPECT_NEAR(peaks[0].direction_rad, 30.0 * kDegree, 6.0 * kDegree);
  EXPECT_NEAR(peaks[0].offset_m, 0.0, 2.0);
  EXPECT_NEAR(peaks[0].length_m, 2.0 * 27.0 / std::cos(30.0 * kDegree), 4.0);
}

TEST(RadonTransform, HasTwoForACrossingAndForATButCannotTellATFromABend) {
  EXPECT_THAT(peaks_of(star_mask({0.0, 90.0, 180.0, 270.0})), SizeIs(2));
  EXPECT_THAT(peaks_of(star_mask({0.0, 120.0, 240.0})), SizeIs(3));
  EXPECT_THAT(peaks_of(star_mask({0.0, 90.0})), SizeIs(2));  // hence arms are counted instead
}

TEST(RadonTransform, OfNoRoadHasNoMaximum) {
  EXPECT_THAT(peaks_of(empty_mask()), SizeIs(0));
  EXPECT_THROW(radon_transform(cv::Mat(10, 20, CV_8UC1), 0.25, 90), std::invalid_argument);
  EXPECT_THROW(radon_transform(cv::Mat(), 0.25, 90), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::landmark_builder

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "painted_panorama.hpp"
#include "panvo/landmarks/heading_search.hpp"
#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::landmarks {
namespace {

using testing::HasSubstr;
constexpr double kDegree = std::numbers::pi / 180.0;

TEST(PanoramaDescriber, SaysTheSameOfTheSamePanorama) {
  const PanoramaDescriber describer({}, 1);
  const PanoramaDescription description = describer.describe(paint_panorama(1));
  EXPECT_EQ(description, describer.describe(paint_panorama(1)));
  EXPECT_EQ(description.large.size(), 200U);
  EXPECT_EQ(description.small.size(), 200U);
}

TEST(MatchLargeScale, FindsTheHeadingOfATurnedPanorama) {  // [Lu2015 5.1] [Lu2015 Eq. 11]
  const PanoramaDescriber describer({}, 1);
  const PanoramaDescription landmark = describer.describe(paint_panorama(1));
  for (const int columns : {0, 90, 540, 990}) {  // multiples of the grid's 30 columns
    const HeadingMatch match = match_large_scale(describer.query(turn_left(paint_panorama(1), columns)), landmark);
    EXPECT_NEAR(match.heading_rad, vision::wrap(columns / 3.0 * kDegree, 360.0 * kDegree), 1e-6);
    EXPECT_NEAR(match.distance, 0.0, 1e-3);
    EXPECT_GT(match.second_distance, 0.3);
  }
}

TEST(MatchLargeScale, TellsPlacesApart) {
  const PanoramaDescriber describer({}, 1);
  const QueryDescription query = describer.query(paint_panorama(1));
  EXPECT_GT(match_large_scale(query, describer.describe(paint_panorama(2))).distance, 0.6F);
  EXPECT_EQ(match_large_scale(query, {}).distance, 1.0F);
}

TEST(SearchHeading, FindsAKnownHeadingFromWithin30Degrees) {  // [Lu2015 Alg. 1]
  const PanoramaDescriber describer({}, 1);
  const PanoramaDescription landmark = describer.describe(paint_panorama(1));
  const QueryDescription query = describer.query(turn_left(paint_panorama(1), 250));
  const double truth = 250 / 3.0 * kDegree;
  for (const double start : {truth - 9.0 * kDegree, truth, truth + 7.0 * kDegree}) {
    EXPECT_NEAR(search_heading_grid(query, landmark, start).heading_rad, truth, 1.2 * kDegree);
    EXPECT_NEAR(search_heading(query, landmark, start).heading_rad, truth, 0.5 * kDegree);
  }
}

TEST(FindFault, NamesWhatIsWrongWithAPanorama) {
  EXPECT_EQ(find_fault(paint_panorama(1)), std::nullopt);
  EXPECT_THAT(find_fault(cv::Mat()).value_or(""), HasSubstr("empty"));
  EXPECT_THAT(find_fault(cv::Mat(500, 900, CV_8UC1)).value_or(""), HasSubstr("900x500"));
  EXPECT_THAT(find_fault(cv::Mat(540, 1080, CV_16UC1)).value_or(""), HasSubstr("8-bit"));
  EXPECT_THAT(find_fault(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(3))).value_or(""), HasSubstr("black"));
  EXPECT_THAT(find_fault(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(255))).value_or(""), HasSubstr("saturated"));
  EXPECT_THAT(find_fault(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(90))).value_or(""), HasSubstr("constant"));
  cv::Mat covered = paint_panorama(1);
  covered.colRange(100, 640).setTo(30);
  EXPECT_THAT(find_fault(covered).value_or(""), HasSubstr("covered: 50 %"));
}

TEST(PanoramaDescriber, DoesNotDescribeWhatIsFaulty) {
  const PanoramaDescriber describer({}, 1);
  EXPECT_THROW(describer.describe(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(describer.query(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(255))), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::landmarks

// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/road_arms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "road_shapes.hpp"

namespace panvo::landmark_builder {
namespace {

using ::testing::SizeIs;

RoadArms arms_of(const cv::Mat& mask, const Eigen::Vector2d& vehicle = {kSide / 2, kSide / 2}) {
  return find_best_centre(mask, vehicle, kResolution_m, {});
}

void expect_directions(const RoadArms& arms, std::vector<double> expected_deg) {
  ASSERT_EQ(arms.arms.size(), expected_deg.size());
  for (const double expected : expected_deg) {
    const bool is_there = std::any_of(arms.arms.begin(), arms.arms.end(), [&](const RoadArm& arm) {
      return std::abs(std::remainder(arm.direction_rad - expected * kDegree, 2.0 * M_PI)) < 20.0 * kDegree;
    });
    EXPECT_TRUE(is_there) << "no arm at " << expected << " degrees";
  }
}

TEST(RayRadon, IsTheWayToTheRoadsEnd) {
  const auto reach = ray_radon(star_mask({0.0, 180.0}), {kSide / 2, kSide / 2}, kResolution_m, 72, 20.0, 0.5);
  EXPECT_NEAR(reach[0], 20.0, 0.3);   // ahead
  EXPECT_NEAR(reach[18], 3.25, 0.4);  // to the left
  EXPECT_NEAR(reach[36], 20.0, 0.3);
  EXPECT_NEAR(reach[54], 3.25, 0.4);
}

TEST(RayRadon, GoesOverAShortGapAndEndsAtALongOne) {
  cv::Mat mask = star_mask({0.0});
  mask.rowRange(kSide / 2 - 42, kSide / 2 - 40).setTo(0);  // 0.5 m at 10 m
  EXPECT_GT(ray_radon(mask, {kSide / 2, kSide / 2}, kResolution_m, 72, 20.0, 1.0)[0], 19.0);
  EXPECT_LT(ray_radon(mask, {kSide / 2, kSide / 2}, kResolution_m, 72, 20.0, 0.25)[0], 10.5);
}

TEST(RoadArms, AStraightRoadHasTwo) { expect_directions(arms_of(star_mask({20.0, 200.0})), {20.0, 200.0}); }

TEST(RoadArms, ACurveHasTwo) {
  EXPECT_THAT(arms_of(curve_mask(20.0)).arms, SizeIs(2));
  EXPECT_THAT(arms_of(curve_mask(40.0)).arms, SizeIs(2));
}

TEST(RoadArms, ABendHasTwo) { EXPECT_THAT(arms_of(star_mask({0.0, 90.0})).arms, SizeIs(2)); }

TEST(RoadArms, ADeadEndHasOne) { EXPECT_LE(arms_of(star_mask({180.0})).arms.size(), 1U); }

TEST(RoadArms, ATHasThree) { expect_directions(arms_of(star_mask({0.0, 90.0, 180.0})), {0.0, 90.0, 180.0}); }

TEST(RoadArms, AYHasThree) { expect_directions(arms_of(star_mask({30.0, 150.0, 270.0})), {30.0, 150.0, 270.0}); }

TEST(RoadArms, AnXHasFour) {
  expect_directions(arms_of(star_mask({10.0, 100.0, 190.0, 280.0})), {10.0, 100.0, 190.0, 280.0});
}

TEST(RoadArms, AStarHasFive) { EXPECT_THAT(arms_of(star_mask({0.0, 72.0, 144.0, 216.0, 288.0})).arms, SizeIs(5)); }

TEST(RoadArms, ASquareHasNone) {
  EXPECT_THAT(arms_of(cv::Mat(kSide, kSide, CV_8UC1, cv::Scalar(255))).arms, SizeIs(0));
}

TEST(RoadArms, NoRoadHasNone) {
  EXPECT_THAT(arms_of(empty_mask()).arms, SizeIs(0));
  EXPECT_THROW(arms_of(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(arms_of(cv::Mat(kSide, kSide, CV_32FC1)), std::invalid_argument);
}

TEST(RoadArms, TheCentreIsWhereTheRoadsMeetNotWhereTheVehicleIs) {
  const Eigen::Vector2d meet(kSide / 2, kSide / 2);
  const RoadArms arms =
      arms_of(star_mask({0.0, 90.0, 180.0, 270.0}), meet + Eigen::Vector2d(-2.0, 5.0) / kResolution_m);
  EXPECT_THAT(arms.arms, SizeIs(4));
  EXPECT_LT((arms.centre_px - meet).norm() * kResolution_m, 2.0);
}

}  // namespace
}  // namespace panvo::landmark_builder

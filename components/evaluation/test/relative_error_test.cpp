// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/relative_error.hpp"

#include <gmock/gmock.h>

#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Turns left by `rate_rad` per metre.
Trajectory turning_line(std::size_t count, double rate_rad) {
  Trajectory path = straight_line(count);
  for (std::size_t i = 1; i < count; ++i) {
    path.poses[i].world_from_base = path.poses[i - 1].world_from_base * make_pose(1, 0, 0, rate_rad);
  }
  return path;
}

TEST(SegmentErrors, AreThePercentageByWhichAPathIsTooLong) {
  const auto result = segment_errors(pairs_of(straight_line(61, 1.013), straight_line(61)));
  ASSERT_TRUE(result);
  ASSERT_EQ(result->by_length.size(), 5u);
  for (const SegmentError& error : result->by_length) {
    EXPECT_NEAR(error.translation_percent, 1.3, 1e-9) << error.length_m;
    EXPECT_NEAR(error.rotation_deg_per_m, 0.0, 1e-9);
  }
  EXPECT_NEAR(result->translation_percent, 1.3, 1e-9);
}

TEST(SegmentErrors, CountEverySegmentThatFits) {
  // 61 poses, 60 m: a segment of 10 m can start at 0..50 m, one of 50 m at 0..10 m.
  const auto result = segment_errors(pairs_of(straight_line(61), straight_line(61)));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->by_length.front().count, 51u);
  EXPECT_EQ(result->by_length.back().count, 11u);
  EXPECT_EQ(result->count, 51u + 41u + 31u + 21u + 11u);
}

// The estimate turns left by c rad per metre, the ground truth is straight. After n steps of 1 m the heading error is n
// c, that is c per metre, and the end is at the sum of n unit steps with headings 0, c, ... (n - 1) c.
TEST(SegmentErrors, OfAConstantTurnAreAsReckonedByHand) {
  const double c = 0.002;
  const int n = 20;
  Eigen::Vector2d end(0, 0);
  for (int i = 0; i < n; ++i) end += Eigen::Vector2d(std::cos(i * c), std::sin(i * c));
  const double expected_percent = 100.0 * (end - Eigen::Vector2d(n, 0)).norm() / n;

  const auto result = segment_errors(pairs_of(turning_line(60, c), straight_line(60)), {{20.0}, 1});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->translation_percent, expected_percent, 1e-9);
  EXPECT_NEAR(result->rotation_deg_per_m, c * 180.0 / M_PI, 1e-9);
}

TEST(SegmentErrors, DoNotDependOnTheFrameOfTheEstimate) {
  const Trajectory estimate = turning_line(60, 0.002);
  const auto here = segment_errors(pairs_of(estimate, straight_line(60)));
  const auto there = segment_errors(pairs_of(transformed(estimate, make_pose(5, 6, 7, 1, 0.5, -2)), straight_line(60)));
  EXPECT_NEAR(here->translation_percent, there->translation_percent, 1e-9);
  EXPECT_NEAR(here->rotation_deg_per_m, there->rotation_deg_per_m, 1e-9);
}

TEST(SegmentErrors, StartAtEveryTenthPoseForKittisOwnLengths) {
  const auto result = segment_errors(pairs_of(straight_line(301), straight_line(301)));
  ASSERT_TRUE(result);
  EXPECT_THAT(result->by_length.front().length_m, 100.0);
  EXPECT_EQ(result->by_length.front().count, 21u);  // from 0, 10, ... 200 m
  EXPECT_EQ(result->by_length.size(), 3u);
}

TEST(SegmentErrors, AreAbsentIfNoneFits) {
  EXPECT_FALSE(segment_errors(pairs_of(straight_line(20), straight_line(20)), {{100.0}, 1}));
  EXPECT_FALSE(segment_errors(pairs_of(straight_line(20, 0.0), straight_line(20, 0.0))));
}

TEST(SegmentErrors, RefuseALengthThatIsNotPositive) {
  const auto pairs = pairs_of(straight_line(20), straight_line(20));
  EXPECT_THAT(input_error_of([&] { segment_errors(pairs, {{5.0, -1.0}, 1}); }), HasSubstr("must be positive"));
  EXPECT_THAT(input_error_of([&] { segment_errors(pairs, {{NAN}, 1}); }), HasSubstr("must be positive"));
}

TEST(SuitableSegmentLengths, FollowThePath) {
  EXPECT_THAT(suitable_segment_lengths_m(58.0), ElementsAre(10, 20, 30, 40, 50));
  EXPECT_THAT(suitable_segment_lengths_m(1200.0), ElementsAre(100, 200, 300, 400, 500, 600, 700, 800));
  EXPECT_THAT(suitable_segment_lengths_m(20.0), ElementsAre(2, 4, 6, 8, 10));
  EXPECT_THAT(suitable_segment_lengths_m(0.0), ElementsAre());
}

TEST(RelativeErrorPerFrame, IsTheErrorOfOneStep) {
  const auto result = relative_error_per_frame(pairs_of(turning_line(30, 0.01), straight_line(30)));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->translation.count, 29u);
  EXPECT_NEAR(result->translation.max, 0.0, 1e-12);  // each step is 1 m ahead, then turns
  EXPECT_NEAR(result->rotation_deg.mean, 0.01 * 180.0 / M_PI, 1e-9);
}

TEST(RelativeErrorPerFrame, PassesOverMissingFrames) {
  Trajectory estimate = straight_line(30, 1.1);
  estimate.poses.erase(estimate.poses.begin() + 10, estimate.poses.begin() + 15);
  const auto result = relative_error_per_frame(pairs_of(estimate, straight_line(30)));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->translation.count, 23u);
  EXPECT_NEAR(result->translation.max, 0.1, 1e-9);
}

TEST(RelativeErrorPerMetre, IsDividedByTheTrueLengthOfTheStretch) {
  // With steps of 0.4 m, the shortest segment of at least 1 m is 1.2 m long; 5 % too long is still 0.05 m per metre.
  const auto result = relative_error_per_metre(pairs_of(straight_line(40, 0.42), straight_line(40, 0.4)));
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->translation.mean, 0.05, 1e-9);
}

TEST(RelativeErrorPerMetre, IsAbsentBelowOneMetre) {
  EXPECT_FALSE(relative_error_per_metre(pairs_of(straight_line(9, 0.1), straight_line(9, 0.1))));
}

}  // namespace
}  // namespace panvo::evaluation

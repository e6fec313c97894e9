// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/evaluation.hpp"

#include <gmock/gmock.h>

#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;

Estimate estimate_of(const Trajectory& trajectory) { return {"e", trajectory, std::nullopt, {}, std::nullopt}; }

TEST(Evaluation, OfThePathItselfHasNoError) {
  const Evaluation e = evaluate(estimate_of(winding_path(200)), winding_path(200));
  EXPECT_EQ(e.pairs, 200u);
  EXPECT_NEAR(e.coverage_percent, 100.0, 1e-9);
  EXPECT_LT(e.ate_start_m->max, 1e-9);
  EXPECT_LT(e.ate_se3_m->max, 1e-9);
  EXPECT_NEAR(*e.scale_error_percent, 0.0, 1e-9);
  EXPECT_NEAR(*e.end_error_percent, 0.0, 1e-9);
  EXPECT_NEAR(e.segments->translation_percent, 0.0, 1e-9);
  EXPECT_NEAR(e.per_frame->translation.max, 0.0, 1e-9);
}

// Both alignments remove the difference of frames.
TEST(Evaluation, DoesNotDependOnTheFrameOfTheEstimate) {
  const auto moved = transformed(winding_path(200), make_pose(100, -50, 3, 2.0, 0.5, -1.0));
  const Evaluation e = evaluate(estimate_of(moved), winding_path(200));
  EXPECT_LT(e.ate_start_m->max, 1e-9);
  EXPECT_LT(e.ate_se3_m->max, 1e-9);
}

TEST(Evaluation, TellsHowMuchTooLongAPathIs) {
  const Evaluation e =
      evaluate(estimate_of(transformed(winding_path(200), make_pose(0, 0, 0), 1.02)), winding_path(200));
  EXPECT_NEAR(*e.scale_error_percent, 2.0, 1e-9);
  EXPECT_NEAR(e.segments->translation_percent, 2.0, 0.2);  // the chords of a winding path are shorter than the path
}

TEST(Evaluation, GivesTheEndErrorInPercentOfThePath) {
  const Evaluation e = evaluate(estimate_of(straight_line(51, 1.01)), straight_line(51));
  EXPECT_NEAR(*e.end_error_m, 0.5, 1e-9);
  EXPECT_NEAR(*e.end_error_percent, 1.0, 1e-9);
  EXPECT_NEAR(*e.end_rotation_deg, 0.0, 1e-9);
}

TEST(Evaluation, TellsWhatPartOfTheGroundTruthIsCovered) {
  Trajectory half = straight_line(51);
  half.poses.resize(26);
  const Evaluation e = evaluate(estimate_of(half), straight_line(51));
  EXPECT_NEAR(e.coverage_percent, 50.0, 1e-9);
  EXPECT_NEAR(e.path_length_m, 25.0, 1e-9);
  EXPECT_NEAR(e.duration_s, 2.5, 1e-9);
}

TEST(Evaluation, OfAPathThatStaysInPlaceLeavesOutWhatItCannotSay) {
  const Evaluation e = evaluate(estimate_of(straight_line(20, 0.0)), straight_line(20, 0.0));
  EXPECT_NEAR(e.ate_start_m->max, 0.0, 1e-12);
  EXPECT_FALSE(e.ate_se3_m);
  EXPECT_FALSE(e.scale_error_percent);
  EXPECT_FALSE(e.end_error_percent);
  EXPECT_FALSE(e.segments);
  EXPECT_FALSE(e.per_metre);
  EXPECT_TRUE(e.per_frame);
  EXPECT_FALSE(e.nees);
}

TEST(Evaluation, RefusesAnAlignmentThatThePathDoesNotDetermine) {
  Options options;
  options.alignment = Alignment::kSe3;
  EXPECT_THAT(input_error_of([&] { evaluate(estimate_of(straight_line(20, 0.0)), straight_line(20), options); }),
              HasSubstr("cannot be aligned by se3"));
}

TEST(Evaluation, ChecksCovariancesAgainstTheOdometryTheyBelongTo) {
  Estimate estimate = estimate_of(straight_line(21, 1.5));  // the enhanced path, to which the covariances do not belong
  estimate.odometry = straight_line(21);
  estimate.covariances.emplace();
  for (const StampedPose& pose : estimate.odometry.poses) {
    (*estimate.covariances)[pose.stamp_ns] = {Matrix6d::Identity(), Matrix6d::Identity()};
  }
  const Evaluation e = evaluate(estimate, straight_line(21));
  ASSERT_TRUE(e.nees);
  EXPECT_EQ(e.nees->motion.samples, 20u);
  EXPECT_NEAR(e.nees->motion.mean, 0.0, 1e-9);
}

}  // namespace
}  // namespace panvo::evaluation

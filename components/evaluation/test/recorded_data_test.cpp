// SPDX-License-Identifier: Apache-2.0
// Reads real files of the supported formats; skipped if the recordings are absent.
#include <gtest/gtest.h>

#include "panvo/evaluation/evaluation.hpp"
#include "panvo/evaluation/trajectory_files.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::evaluation {
namespace {

TEST(RecordedGroundTruth, OfKittiGoesForwardAndTurnsToTheRight) {
  const auto folder = panvo::test::recorded_data("kitti_03");
  PANVO_NEEDS_RECORDING(folder);
  const Trajectory truth = read_trajectory(folder);
  ASSERT_EQ(truth.poses.size(), 99u);
  EXPECT_NEAR(path_length_m(truth), 58.3, 0.1);
  const Eigen::Isometry3d& end = truth.poses.back().world_from_base;
  EXPECT_GT(end.translation().x(), 50.0);
  EXPECT_LT(end.translation().y(), -1.0);
  EXPECT_LT(rotation_vector(end.linear()).z(), -0.5);
  EXPECT_NEAR(end.translation().z(), 0.0, 2.0);  // nearly flat
  EXPECT_EQ(truth.poses.back().stamp_ns, 9'800'000'000);
}

TEST(RecordedGroundTruth, OfTheCampusClipIsReadToItsEnd) {
  const auto folder = panvo::test::recorded_data("campus_clip");
  PANVO_NEEDS_RECORDING(folder);
  const Trajectory truth = read_trajectory(folder);
  EXPECT_EQ(truth.poses.size(), 707u);
  EXPECT_EQ(median_period_ns(truth), 40'000'000);
  EXPECT_NEAR(path_length_m(truth), 92.0, 0.5);
  // The vehicle moves along its x axis.
  const Eigen::Isometry3d step = truth.poses[300].world_from_base.inverse() * truth.poses[301].world_from_base;
  EXPECT_GT(step.translation().x(), 0.99 * step.translation().norm());
}

TEST(RecordedGroundTruth, EvaluatesAgainstItselfWithoutError) {
  const auto folder = panvo::test::recorded_data("kitti_03");
  PANVO_NEEDS_RECORDING(folder);
  const Trajectory truth = read_trajectory(folder);
  const Evaluation e = evaluate(read_estimate(folder), truth);
  EXPECT_LT(e.ate_start_m->max, 1e-9);
  ASSERT_TRUE(e.segments);
  EXPECT_EQ(e.segments->by_length.size(), 5u);
}

}  // namespace
}  // namespace panvo::evaluation

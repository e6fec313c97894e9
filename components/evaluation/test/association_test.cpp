// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/association.hpp"

#include <gmock/gmock.h>

#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

using ::testing::HasSubstr;

Trajectory shifted(Trajectory trajectory, std::int64_t by_ns) {
  for (StampedPose& pose : trajectory.poses) pose.stamp_ns += by_ns;
  return trajectory;
}

TEST(Interpolation, IsHalfWayBetweenTwoPoses) {
  const StampedPose before{0, make_pose(0, 0, 0, 0.0)};
  const StampedPose after{100, make_pose(2, 4, 6, 0.6)};
  const Eigen::Isometry3d middle = interpolate(before, after, 50);
  EXPECT_TRUE(middle.isApprox(make_pose(1, 2, 3, 0.3), 1e-12));
}

TEST(Interpolation, TakesTheShortWayRoundBetweenOppositeQuaternions) {
  const StampedPose before{0, make_pose(0, 0, 0, 3.1)};
  const StampedPose after{100, make_pose(0, 0, 0, -3.1)};
  EXPECT_TRUE(interpolate(before, after, 50).isApprox(make_pose(0, 0, 0, M_PI), 1e-9));
}

TEST(Association, InterpolatesTheGroundTruthAtTheEstimatesStamps) {
  const Trajectory truth = straight_line(11);
  const Association result = associate(shifted(straight_line(10), 30'000'000), truth);
  ASSERT_EQ(result.pairs.size(), 10u);
  EXPECT_EQ(result.unmatched, 0u);
  EXPECT_EQ(result.max_difference_ns, 30'000'000);
  EXPECT_NEAR(result.pairs[4].map_from_base.translation().x(), 4.3, 1e-12);
}

TEST(Association, TakesTheNearestWithinHalfAPeriod) {
  const Trajectory truth = straight_line(10);
  const Association result = associate(shifted(straight_line(10), 30'000'000), truth, {AssociationMethod::kNearest, 0});
  ASSERT_EQ(result.pairs.size(), 10u);
  EXPECT_EQ(result.tolerance_ns, 50'000'000);
  EXPECT_DOUBLE_EQ(result.pairs[4].map_from_base.translation().x(), 4.0);
}

TEST(Association, DoesNotBridgeAGapOfTheGroundTruth) {
  Trajectory truth = straight_line(20);
  truth.poses.erase(truth.poses.begin() + 5, truth.poses.begin() + 10);  // 0.6 s without ground truth
  const Association result = associate(straight_line(20), truth);
  EXPECT_EQ(result.unmatched, 5u);
  for (const PosePair& pair : result.pairs) EXPECT_TRUE(pair.estimate_index < 5 || pair.estimate_index >= 10);
}

TEST(Association, LeavesOutWhatLiesBeforeAndAfterTheGroundTruth) {
  Trajectory truth = straight_line(20);
  truth.poses.erase(truth.poses.begin(), truth.poses.begin() + 3);
  truth.poses.resize(14);
  const Association result = associate(straight_line(20), truth);
  EXPECT_EQ(result.pairs.size(), 14u);
  EXPECT_EQ(result.pairs.front().estimate_index, 3u);
}

TEST(Association, ForgivesRoundedDigitsAtTheEnds) {
  EXPECT_EQ(associate(shifted(straight_line(10), 700), straight_line(10)).pairs.size(), 10u);
  EXPECT_EQ(associate(shifted(straight_line(10), -700), straight_line(10)).pairs.size(), 10u);
}

TEST(Association, NamesBothSpansOfTimeIfTheyDoNotMeet) {
  const std::string error =
      input_error_of([] { associate(straight_line(10), shifted(straight_line(10), 1'700'000'000'000'000'000)); });
  EXPECT_THAT(error, HasSubstr("only 0 of its 10 poses overlap the ground truth"));
  EXPECT_THAT(error, HasSubstr("from 0.000 to 0.900 s"));
  EXPECT_THAT(error, HasSubstr("from 1700000000.000 to 1700000000.900 s"));
  EXPECT_THAT(error, HasSubstr("same clock"));
}

TEST(Association, RefusesGroundTruthOfOnePose) {
  EXPECT_THAT(input_error_of([] { associate(straight_line(10), straight_line(1)); }),
              HasSubstr("fewer than two poses"));
}

}  // namespace
}  // namespace panvo::evaluation

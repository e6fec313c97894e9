// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/panoramic_motion.hpp"

#include <gtest/gtest.h>

#include "park.hpp"

namespace panvo::all_round_odometry {
namespace {

Eigen::Isometry3d step_between(int from, int to) { return Park::vehicle(from).inverse() * Park::vehicle(to); }

/// Learns from panoramas 1 to `last`.
void drive(PanoramicMotion& motion, Park& park, int last) {
  for (int now = 1; now <= last; ++now) motion.learn(park.seen(now, Park::references(now)), step_between(now - 1, now));
}

TEST(PanoramicMotion, GoesOnInMetresOverManyReferences) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Park park(seed);
    PanoramicMotion motion(kCamera);
    drive(motion, park, 12);
    Eigen::Isometry3d estimate = Park::vehicle(12);
    double scale_variance = 0.0;
    constexpr int kLast = 62;  // 50 m and sixteen references later
    for (int now = 13; now <= kLast; ++now) {
      const auto step = motion.measure(park.seen(now, Park::references(now)), step_between(0, 1));
      ASSERT_TRUE(step) << now;
      EXPECT_GT(step->agreeing_share, 0.8);
      EXPECT_GE(step->scale_variance, scale_variance);
      scale_variance = step->scale_variance;
      estimate = estimate * step->before_from_now;
    }
    const double off_m = (estimate.translation() - Park::vehicle(kLast).translation()).norm();
    EXPECT_LT(off_m, 1.0) << "2 % of the way, seed " << seed;
    EXPECT_LT(off_m, 3.0 * std::sqrt(scale_variance) * 50.0 + 0.1) << "the scale's stated error";
    EXPECT_LT(vision::pose_error(estimate, Park::vehicle(kLast)).tail<3>().norm(), 0.02);
  }
}

TEST(PanoramicMotion, TakesThePositionOfTheCameraIntoAccount) {
  for (const bool knows_position : {true, false}) {
    Park park(1, 1e-6);
    PanoramicMotion motion(knows_position ? kCamera : Eigen::Vector3d::Zero());
    drive(motion, park, 12);
    const auto step = motion.measure(park.seen(13, Park::references(13)), step_between(0, 1));
    ASSERT_TRUE(step);
    const double off_m = (step->before_from_now.translation() - step_between(12, 13).translation()).norm();
    EXPECT_EQ(off_m < 3e-3, knows_position) << off_m;
  }
}

TEST(PanoramicMotion, MeasuresNothingBeforeItHasLearned) {
  Park park;
  PanoramicMotion motion(kCamera);
  EXPECT_FALSE(motion.measure(park.seen(1, {0}), step_between(0, 1)));
  motion.learn(park.seen(1, {0}), step_between(0, 1));
  EXPECT_TRUE(motion.measure(park.seen(2, {0}), step_between(0, 1)));
}

TEST(PanoramicMotion, CountsStepsFromTheLastPanoramaOrTheReference) {
  Park park;
  PanoramicMotion motion(kCamera);
  EXPECT_EQ(motion.before_ns(park.seen(3, {2, 0})), Park::stamp_ns(2));
  motion.learn(park.seen(3, {2, 0}), step_between(2, 3));
  EXPECT_EQ(motion.before_ns(park.seen(5, {2})), Park::stamp_ns(3));
  EXPECT_EQ(motion.before_ns(park.seen(5, {4})), Park::stamp_ns(4)) << "nothing is known of panorama 4";
}

TEST(PanoramicMotion, BridgesAPanoramaThatCouldNotBeMeasured) {
  Park park;
  PanoramicMotion motion(kCamera);
  drive(motion, park, 10);
  EXPECT_FALSE(motion.measure(park.seen(11, {9}, 10), step_between(0, 1))) << "ten points may agree by chance";
  const auto step = motion.measure(park.seen(12, {9}), step_between(0, 2));
  ASSERT_TRUE(step);
  EXPECT_LT((step->before_from_now.translation() - step_between(10, 12).translation()).norm(), 0.05);
}

TEST(PanoramicMotion, EndsIfNoReferenceIsKnownAnyMore) {
  Park park;
  PanoramicMotion motion(kCamera);
  drive(motion, park, 10);
  EXPECT_FALSE(motion.measure(park.seen(14, {13}), step_between(0, 4)));
}

TEST(PanoramicMotion, KnowsHowManyPointsAgreeWithAMotion) {
  Park park;
  PanoramicMotion motion(kCamera);
  drive(motion, park, 9);
  const auto seen = park.seen(10, Park::references(10));
  EXPECT_GT(motion.agreeing_share(seen, step_between(9, 10)).value_or(0.0), 0.9);
  EXPECT_LT(motion.agreeing_share(seen, Eigen::Isometry3d::Identity()).value_or(1.0), 0.5);
}

}  // namespace
}  // namespace panvo::all_round_odometry

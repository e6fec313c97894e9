// SPDX-License-Identifier: Apache-2.0
#include "disparity_offset.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

const vision::RectifiedStereo kOffsetStereo{{400.0, 400.0, 320.0, 240.0, 640, 480}, 0.3};
const Eigen::Isometry3d kMotion = vision::se3_exp((vision::Vector6d() << 0.01, 0.0, -0.4, 0.001, 0.02, 0.0).finished());

/// Points of a street before and after `motion`, all disparities too large by `offset_px`; the first `movers` move with
/// the camera.
std::vector<FramePair> points(std::mt19937& random, const Eigen::Isometry3d& motion, double offset_px, int movers = 0) {
  const auto uniform = [&random](double from, double to) {
    return from + (to - from) * static_cast<double>(random() % 100000) / 1e5;
  };
  constexpr double kNoise_px = 0.2;
  const auto see = [&](const Eigen::Vector3d& point) {
    Observation seen;
    seen.pixel = vision::observe(kOffsetStereo, point) + Eigen::Vector3d(0.0, 0.0, offset_px);
    for (int axis = 0; axis < 3; ++axis) seen.pixel[axis] += uniform(-kNoise_px, kNoise_px);
    seen.sigma_px = seen.sigma_disparity_px = kNoise_px / std::sqrt(3.0);
    seen.has_disparity = true;
    return seen;
  };
  std::vector<FramePair> points;
  for (int i = 0; i < 200; ++i) {
    const double z = uniform(5.0, 50.0);
    const Eigen::Vector3d point{uniform(-0.6, 0.6) * z, uniform(-0.4, 0.4) * z, z};
    points.push_back({see(point), see(i < movers ? point : motion * point)});
  }
  return points;
}

TEST(DisparityOffset, IsFoundFromHowNearAndFarPointsMovePast) {
  for (const double offset_px : {-1.1, 0.0, 0.6}) {
    std::mt19937 random(3);
    DisparityOffset offset;
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    for (int frame = 0; frame < 30; ++frame)
      moved = offset.learn(kOffsetStereo, points(random, kMotion, offset_px), kMotion);
    EXPECT_NEAR(offset.px(), offset_px, 0.05);
    EXPECT_LT((moved.translation() - kMotion.translation()).norm(), 0.02 * kMotion.translation().norm());
    EXPECT_NEAR(offset.without({1.0, 2.0, 8.0 + offset_px}).z(), 8.0, 0.05);
  }
}

TEST(DisparityOffset, IsNotLedAstrayByWhatMoves) {
  std::mt19937 random(3);
  DisparityOffset offset;
  for (int frame = 0; frame < 30; ++frame) offset.learn(kOffsetStereo, points(random, kMotion, 0.6, 60), kMotion);
  EXPECT_NEAR(offset.px(), 0.6, 0.08);
}

TEST(DisparityOffset, StaysAsItIsWhileTheCameraIsAtRest) {
  std::mt19937 random(3);
  DisparityOffset offset;
  for (int frame = 0; frame < 30; ++frame) offset.learn(kOffsetStereo, points(random, kMotion, 0.6), kMotion);
  const double known_px = offset.px();
  const Eigen::Isometry3d rest = Eigen::Isometry3d::Identity();
  for (int frame = 0; frame < 1000; ++frame) offset.learn(kOffsetStereo, points(random, rest, 0.6), rest);
  EXPECT_NEAR(offset.px(), known_px, 0.1);
}

TEST(DisparityOffset, IsNotLessCertainAfterALongRestThanAtFirst) {
  std::mt19937 random(3);
  const auto seen = points(random, kMotion, 0.6);
  DisparityOffset fresh, rested;
  for (int frame = 0; frame < 100000; ++frame)
    rested.learn(kOffsetStereo, {}, Eigen::Isometry3d::Identity());  // an hour
  fresh.learn(kOffsetStereo, seen, kMotion);
  rested.learn(kOffsetStereo, seen, kMotion);
  EXPECT_NEAR(rested.px(), fresh.px(), 1e-6);
  EXPECT_GT(std::abs(fresh.px()), 0.01) << "they learn";
}

TEST(DisparityOffset, LearnsNothingFromTooFewPoints) {
  DisparityOffset offset;
  std::mt19937 random(3);
  auto few = points(random, kMotion, 0.6);
  few.resize(1);
  EXPECT_TRUE(offset.learn(kOffsetStereo, few, kMotion).matrix().allFinite());
  EXPECT_NEAR(offset.px(), 0.0, 0.5);
  EXPECT_EQ(offset.learn(kOffsetStereo, {}, kMotion).matrix(), kMotion.matrix());
}

}  // namespace
}  // namespace panvo::binocular_odometry

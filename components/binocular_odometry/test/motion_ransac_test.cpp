// SPDX-License-Identifier: Apache-2.0
#include "motion_ransac.hpp"

#include <gtest/gtest.h>

#include <random>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

const vision::RectifiedStereo kRansacStereo{{400.0, 400.0, 320.0, 240.0, 640, 480}, 0.3};
const Eigen::Isometry3d kMotion =
    vision::se3_exp((vision::Vector6d() << 0.05, -0.02, -0.9, 0.01, 0.08, -0.02).finished());

// Points before and after kMotion with small errors; the first `outliers` move independently.
std::vector<PointPair> pairs(int count, int outliers) {
  std::mt19937 random(2);
  const auto uniform = [&random](double from, double to) {
    return from + (to - from) * static_cast<double>(random() % 100000) / 1e5;
  };
  std::vector<PointPair> pairs;
  for (int i = 0; i < count; ++i) {
    const double z = uniform(4.0, 40.0);
    const Eigen::Vector3d point{uniform(-0.6, 0.6) * z, uniform(-0.4, 0.4) * z, z};
    Eigen::Vector3d moved = kMotion * point;
    if (i < outliers)
      moved += Eigen::Vector3d{0.6 + uniform(0.0, 1.0), uniform(-0.5, 0.5), uniform(-1.0, 1.0)} * 0.2 * z;
    const auto error = [&] { return Eigen::Vector3d{uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(-0.2, 0.2)}; };
    pairs.push_back(
        {vision::observe(kRansacStereo, point) + error(), vision::observe(kRansacStereo, moved) + error(), true});
  }
  return pairs;
}

TEST(MotionRansac, FindsTheMotionAmongOutliers) {
  const auto points = pairs(150, 75);
  const auto found = estimate_motion(kRansacStereo, points, {}, {});
  ASSERT_TRUE(found);
  EXPECT_LT(vision::se3_log(found->current_from_previous * kMotion.inverse()).norm(), 0.01);
  EXPECT_NEAR(found->inliers, 75, 5);
  EXPECT_FALSE(found->is_inlier[0]);
  EXPECT_TRUE(found->is_inlier[149]);
}

TEST(MotionRansac, GivesTheSameTwice) {
  const auto points = pairs(80, 30);
  const auto first = estimate_motion(kRansacStereo, points, {}, {}),
             second = estimate_motion(kRansacStereo, points, {}, {});
  EXPECT_EQ(first->current_from_previous.matrix(), second->current_from_previous.matrix());
  EXPECT_EQ(first->is_inlier, second->is_inlier);
}

TEST(MotionRansac, TakesAGoodGuessWithoutDrawing) {
  const auto points = pairs(60, 10);
  const std::array guesses{kMotion};
  const auto found = estimate_motion(kRansacStereo, points, guesses, {.ransac_iterations = 0});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->inliers, 50);
}

TEST(MotionRansac, BelievesWhatStandsStillMoreThanAMajority) {
  auto points = pairs(100, 0);
  const Eigen::Isometry3d other =
      vision::se3_exp((vision::Vector6d() << 0.4, 0.0, 0.1, 0.0, 0.0, 0.0).finished()) * kMotion;
  for (std::size_t i = 0; i < 70; ++i) {
    points[i].current = vision::observe(kRansacStereo, other * *vision::triangulate(kRansacStereo, points[i].previous));
    points[i].vote = 0.1;
  }
  const auto found = estimate_motion(kRansacStereo, points, {}, {});
  ASSERT_TRUE(found);
  EXPECT_LT(vision::se3_log(found->current_from_previous * kMotion.inverse()).norm(), 0.05);  // the other is 0.4 away
}

TEST(MotionRansac, HasNoMotionForNoPoints) { EXPECT_FALSE(estimate_motion(kRansacStereo, {}, {}, {})); }

}  // namespace
}  // namespace panvo::binocular_odometry

// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/alignment.hpp"

#include <gtest/gtest.h>

#include "panvo/evaluation/pose_error.hpp"
#include "trajectories.hpp"

namespace panvo::evaluation {
namespace {

const Eigen::Isometry3d kOffset = make_pose(12.0, -7.0, 3.0, 2.1, -0.4, 0.9);

double sum_of_squares(const std::vector<PosePair>& pairs, const MapFromOdom& map_from_odom) {
  double sum = 0.0;
  for (const PosePair& pair : pairs) {
    sum += ((map_from_odom * pair.odom_from_base).translation() - pair.map_from_base.translation()).squaredNorm();
  }
  return sum;
}

std::vector<PosePair> noisy_pairs() {
  Trajectory estimate = transformed(winding_path(100), kOffset.inverse(), 1.1);
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 0.3);
  for (StampedPose& pose : estimate.poses) {
    pose.world_from_base.translation() += Eigen::Vector3d{noise(generator), noise(generator), noise(generator)};
  }
  return pairs_of(estimate, winding_path(100));
}

TEST(Alignment, BySe3FindsAKnownTransform) {
  const auto pairs = pairs_of(transformed(winding_path(50), kOffset.inverse()), winding_path(50));
  const auto result = align(pairs, Alignment::kSe3);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->rigid.isApprox(kOffset, 1e-9));
  EXPECT_DOUBLE_EQ(result->scale, 1.0);
}

TEST(Alignment, BySim3FindsAKnownTransformAndScale) {
  const auto pairs = pairs_of(transformed(winding_path(50), kOffset.inverse(), 1.25), winding_path(50));
  const auto result = align(pairs, Alignment::kSim3);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->scale, 0.8, 1e-9);
  EXPECT_LT(sum_of_squares(pairs, *result), 1e-15);
}

TEST(Alignment, ByTheStartLaysTheFirstPoseOnTheTrueOne) {
  const auto pairs = pairs_of(transformed(winding_path(50), kOffset.inverse()), winding_path(50));
  const auto result = align(pairs, Alignment::kStart);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->rigid.isApprox(kOffset, 1e-9));
}

TEST(Alignment, ByNothingLeavesTheEstimateAsItIs) {
  const auto result = align(noisy_pairs(), Alignment::kNone);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->rigid.isApprox(Eigen::Isometry3d::Identity()));
}

// No small change in any of the six or seven degrees of freedom reduces the sum of squares.
TEST(Alignment, CannotBeBetteredByTrying) {
  const std::vector<PosePair> pairs = noisy_pairs();
  for (const Alignment alignment : {Alignment::kSe3, Alignment::kSim3}) {
    const auto best = align(pairs, alignment);
    ASSERT_TRUE(best);
    const double least = sum_of_squares(pairs, *best);
    for (int direction = 0; direction < 6; ++direction) {
      for (const double size : {-1e-3, -1e-5, 1e-5, 1e-3}) {
        MapFromOdom moved = *best;
        if (direction < 3) {
          moved.rigid.translation()[direction] += size;
        } else {
          moved.rigid = moved.rigid * Eigen::AngleAxisd(size, Eigen::Vector3d::Unit(direction - 3));
        }
        EXPECT_GT(sum_of_squares(pairs, moved), least) << to_string(alignment) << " " << direction << " " << size;
      }
    }
  }
  MapFromOdom scaled = *align(pairs, Alignment::kSim3);
  const double least = sum_of_squares(pairs, scaled);
  scaled.scale += 1e-5;
  EXPECT_GT(sum_of_squares(pairs, scaled), least);
}

TEST(Alignment, IsARotationAlsoForAMirroredPath) {
  std::vector<PosePair> pairs = noisy_pairs();
  for (PosePair& pair : pairs) pair.odom_from_base.translation().y() *= -1.0;
  const auto result = align(pairs, Alignment::kSe3);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->rigid.linear().determinant(), 1.0, 1e-9);
}

TEST(Alignment, AlignsThePositionsOfAStraightLine) {
  const auto pairs = pairs_of(transformed(straight_line(30), kOffset.inverse()), straight_line(30));
  const auto result = align(pairs, Alignment::kSe3);
  ASSERT_TRUE(result);
  EXPECT_LT(sum_of_squares(pairs, *result), 1e-15);
}

TEST(Alignment, IsAbsentForAPathThatStaysInPlace) {
  const auto pairs = pairs_of(straight_line(30, 0.0), straight_line(30));
  EXPECT_FALSE(align(pairs, Alignment::kSe3));
  EXPECT_FALSE(align(pairs, Alignment::kSim3));
  EXPECT_FALSE(align({}, Alignment::kStart));
}

}  // namespace
}  // namespace panvo::evaluation

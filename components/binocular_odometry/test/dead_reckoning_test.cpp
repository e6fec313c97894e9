// SPDX-License-Identifier: Apache-2.0
#include "../src/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace panvo::binocular_odometry {
namespace {

constexpr double kAcceleration = 2.0, kTurning = 0.1;

DeadReckoning after(const vision::Vector6d& velocity, std::int64_t each_ms, int times) {
  DeadReckoning unseen(kAcceleration, kTurning);
  unseen.begin(DeadReckoning::Velocity::kMeasured);
  for (int i = 0; i < times; ++i) unseen.go_on(1e-3 * static_cast<double>(each_ms) * velocity, each_ms * 1'000'000);
  return unseen;
}

const vision::Vector6d kAhead = (vision::Vector6d() << 0.0, 0.0, 8.0, 0.0, 0.2, 0.0).finished();

TEST(DeadReckoning, IsAsUncertainAfterManyFramesAsAfterOneGap) {
  const auto frames = after(kAhead, 40, 100), gap = after(kAhead, 4000, 1);
  EXPECT_TRUE(frames.begin_from_current().isApprox(gap.begin_from_current(), 1e-9));
  EXPECT_TRUE(frames.covariance().isApprox(gap.covariance(), 0.02));
}

TEST(DeadReckoning, GrowsWithTimeAsAVelocityThatWanders) {
  for (const double seconds : {1.0, 4.0, 9.0}) {
    const auto still = after(vision::Vector6d::Zero(), 20, static_cast<int>(50 * seconds));
    const double expected_m = kAcceleration * std::sqrt(std::pow(seconds, 3) / 3.0);
    EXPECT_NEAR(std::sqrt(still.covariance()(0, 0)), expected_m, 1e-3 * expected_m) << seconds << " s";
  }
}

TEST(DeadReckoning, NeverKnowsLessOfADirectionThanNothing) {
  const auto long_after = after(kAhead, 60'000, 10);
  EXPECT_TRUE(long_after.covariance().allFinite());
  EXPECT_LE(long_after.covariance().diagonal().tail<3>().maxCoeff(), M_PI * M_PI / 3.0 + 1e-9);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<vision::Matrix6d>(long_after.covariance()).eigenvalues().minCoeff(), 0.0);
}

TEST(DeadReckoning, IsUncertainAtOnceWhereNoVelocityWasMeasured) {
  DeadReckoning unseen(kAcceleration, kTurning);
  unseen.begin(DeadReckoning::Velocity::kUnknown);
  unseen.go_on(vision::Vector6d::Zero(), 1'000'000'000);
  EXPECT_GT(std::sqrt(unseen.covariance()(0, 0)), 10.0);
}

/// The errors of drives with random-walk velocity agree with the covariance.
TEST(DeadReckoning, ItsErrorLiesWithinItsCovariance) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  constexpr int kDrives = 400, kSteps = 100;
  constexpr double kStep_s = 0.03;
  const auto unseen = after(kAhead, 3000, 1);
  double nees = 0.0;
  for (int drive = 0; drive < kDrives; ++drive) {
    Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
    vision::Vector6d velocity = kAhead;
    for (int i = 0; i < kSteps; ++i) {
      for (int axis = 0; axis < 6; ++axis) {
        velocity[axis] += (axis < 3 ? kAcceleration : kTurning) * std::sqrt(kStep_s) * normal(random);
      }
      truth = truth * vision::se3_exp(velocity * kStep_s);
    }
    const vision::Vector6d error = vision::pose_error(unseen.begin_from_current(), truth);
    nees += error.dot(unseen.covariance().ldlt().solve(error)) / kDrives;
  }
  EXPECT_GT(nees, 4.5);
  EXPECT_LT(nees, 8.0);
}

}  // namespace
}  // namespace panvo::binocular_odometry

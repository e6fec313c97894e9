// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "panvo/odometry_fusion/odometry_fusion.hpp"

namespace panvo::odometry_fusion {
namespace {

constexpr double kStep_m = 0.2;  // 5 m/s at 25 Hz
constexpr int kRefused = 5;

/// Straight ahead; the stereo odometry was restarted on the way, so that the fused path is not its own. Then its clock
/// is set back.
class ClockSetBack : public ::testing::TestWithParam<std::int64_t> {
 protected:
  ClockSetBack() {
    for (int i = 0; i < 200; ++i) {
      if (i == 50) stereo_.odom_from_base.translation().x() += 1000.0;
      drive();
      EXPECT_TRUE(fusion_.add(stereo_));
      while (const auto fused = fusion_.next()) last_ = *fused;
    }
    stereo_.stamp_ns -= GetParam();
  }

  void drive() {
    stereo_.stamp_ns += 40'000'000;
    stereo_.odom_from_base.translation().x() += kStep_m;
    stereo_.covariance += 1e-4 * vision::Matrix6d::Identity();
    driven_m_ += kStep_m;
  }

  FusedPose begin_again() {
    for (int i = 0; i < kRefused; ++i) {
      drive();
      EXPECT_FALSE(fusion_.add(stereo_));
    }
    EXPECT_TRUE(fusion_.begin_again(stereo_, kRefused));
    const auto first = fusion_.next();
    EXPECT_TRUE(first);
    return first.value_or(FusedPose{});
  }

  OdometryFusion fusion_{{}};
  StereoPose stereo_{.stamp_ns = 1'000'000'000'000};
  FusedPose last_;
  double driven_m_ = 0.0;
};

TEST_P(ClockSetBack, LeavesThePathWhereItIs) {
  const double error_m = last_.odom_from_base.translation().x() - driven_m_;
  ASSERT_LT(std::abs(error_m), 1.0);
  FusedPose fused = begin_again();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(fused.stamp_ns, stereo_.stamp_ns);
    EXPECT_NEAR(fused.odom_from_base.translation().x() - driven_m_, error_m, 0.01);
    EXPECT_GE(fused.covariance.trace(), last_.covariance.trace());
    last_ = fused;
    drive();
    EXPECT_TRUE(fusion_.add(stereo_));
    fused = fusion_.next().value_or(FusedPose{});
  }
}

TEST_P(ClockSetBack, LeavesTheFirstTwistUnknown) {
  const FusedPose first = begin_again();
  EXPECT_EQ(first.twist.norm(), 0.0);
  EXPECT_GE(first.twist_covariance.diagonal().minCoeff(), 1e6);
  drive();
  EXPECT_TRUE(fusion_.add(stereo_));
  const FusedPose second = fusion_.next().value_or(FusedPose{});
  EXPECT_GT(second.twist[0], 0.0);
  EXPECT_LT(second.twist_covariance.diagonal().maxCoeff(), 100.0);
}

TEST_P(ClockSetBack, LeavesThePathWhereItIsIfTheStereoOdometryWasRestartedToo) {
  stereo_.odom_from_base.setIdentity();
  stereo_.covariance.setZero();
  const FusedPose fused = begin_again();
  EXPECT_LT((fused.odom_from_base.translation() - last_.odom_from_base.translation()).norm(), kStep_m);
  const double grown_m2 = fused.covariance(0, 0) - last_.covariance(0, 0);
  EXPECT_GT(grown_m2, std::pow(kRefused * kStep_m, 2)) << "the way of the refused poses is missing";
}

TEST_P(ClockSetBack, IsNotMistakenForPosesThatAreNotFinite) {
  StereoPose broken = stereo_;
  broken.covariance(0, 0) = NAN;
  EXPECT_FALSE(fusion_.begin_again(broken, kRefused));
  EXPECT_EQ(fusion_.latest()->stamp_ns, last_.stamp_ns);
}

INSTANTIATE_TEST_SUITE_P(By, ClockSetBack, ::testing::Values(10'000'000'000, 600'000'000'000));

}  // namespace
}  // namespace panvo::odometry_fusion

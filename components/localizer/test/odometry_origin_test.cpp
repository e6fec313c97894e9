// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/odometry_origin.hpp"

#include <gtest/gtest.h>

namespace panvo::localizer {
namespace {

/// A vehicle at 5 m/s along x, 25 Hz, with an odometry origin `offset_m` to the left, `since` messages ago.
OdometryPose told(int i, double offset_m = 0.0, int since = 0) {
  OdometryPose odometry;
  odometry.stamp_ns = 40'000'000LL * i;
  odometry.odom_from_base.translation() = Eigen::Vector3d(0.2 * (i - since), offset_m, 0.0);
  odometry.covariance = 1e-4 * (i - since + 1) * vision::Matrix6d::Identity();
  return odometry;
}

TEST(OdometryOrigin, LeavesOdometryAsItIs) {
  OdometryOrigin origin(70.0);
  for (int i = 0; i < 50; ++i) {
    const auto taken = origin.take(told(i));
    ASSERT_TRUE(taken.odometry);
    EXPECT_TRUE(taken.odometry->odom_from_base.isApprox(told(i).odom_from_base, 0.0));
    EXPECT_EQ(taken.odometry->covariance, told(i).covariance);
  }
}

TEST(OdometryOrigin, RefusesAPoseThatNoVehicleReaches) {
  OdometryOrigin origin(70.0);
  for (int i = 0; i < 60; ++i) {
    const bool is_absurd = i % 7 == 3;
    const auto taken = origin.take(told(i, is_absurd ? 5000.0 : 0.0));
    EXPECT_EQ(taken.odometry.has_value(), !is_absurd) << i;
    EXPECT_FALSE(taken.is_new_origin) << i;
    EXPECT_EQ(taken.reason.empty(), !is_absurd) << i;
  }
}

TEST(OdometryOrigin, GoesOnFromWhereItWasWhenOdometryBeginsAnew) {
  OdometryOrigin origin(70.0);
  OdometryPose last;
  for (int i = 0; i < 500; ++i) last = *origin.take(told(i)).odometry;
  std::optional<OdometryPose> begun;
  for (int i = 500; i < 520; ++i) {
    const auto taken = origin.take(told(i, 0.0, 500));
    if (!taken.odometry) continue;
    if (!begun) {
      EXPECT_TRUE(taken.is_new_origin);
      EXPECT_FALSE(taken.odometry->is_reliable);  // the gap was not measured
      EXPECT_TRUE(taken.odometry->odom_from_base.isApprox(last.odom_from_base, 1e-12));
      begun = taken.odometry;
    }
    EXPECT_GE(taken.odometry->covariance(0, 0), last.covariance(0, 0));
    last = *taken.odometry;
  }
  ASSERT_TRUE(begun);
  EXPECT_NEAR(last.odom_from_base.translation().x() - begun->odom_from_base.translation().x(), 15 * 0.2, 1e-9);
}

}  // namespace
}  // namespace panvo::localizer

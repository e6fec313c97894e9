// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/odometry_origin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "panvo/vision/seconds.hpp"

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

/// An odometry that is restarted after a way, with a gap.
struct Restart {
  double way_m, gap_s;
  bool grows = true;  // its covariance

  /// Of the pose 20 messages later; 1e9 if not exactly one restart was noticed.
  double error_m() const {
    OdometryOrigin origin(70.0);
    const int count = static_cast<int>(std::lround(way_m / 0.2)) + 1;
    for (int i = 0; i < count; ++i) origin.take(of(told(i)));
    const double start_m = 0.2 * (count - 1) + 5.0 * gap_s;
    std::optional<OdometryPose> last;
    int restarts = 0;
    for (int i = 0; i < 20; ++i) {
      OdometryPose restarted = of(told(i));
      restarted.stamp_ns += told(count - 1).stamp_ns + vision::to_ns(gap_s);
      const auto taken = origin.take(restarted);
      restarts += taken.is_new_origin ? 1 : 0;
      if (taken.is_new_origin) {
        EXPECT_FALSE(taken.odometry->is_reliable) << "the gap was not measured";
      }
      last = taken.odometry;
    }
    if (restarts != 1 || !last) return 1e9;
    return (last->odom_from_base.translation() - Eigen::Vector3d(start_m + 19 * 0.2, 0.0, 0.0)).norm();
  }

 private:
  OdometryPose of(OdometryPose odometry) const {
    if (!grows) odometry.covariance = 0.01 * vision::Matrix6d::Identity();
    return odometry;
  }
};

TEST(OdometryOrigin, GoesOnWhereTheMotionLeadsWhenOdometryBeginsAnew) {
  for (const double way_m : {6.0, 12.0, 18.0, 25.0, 100.0}) {
    for (const double gap_s : {0.1, 1.0, 3.0}) {
      EXPECT_LT(Restart({way_m, gap_s}).error_m(), 0.01) << way_m << " m from the origin, after " << gap_s << " s";
    }
  }
}

TEST(OdometryOrigin, NoticesAJumpOutOfReachWhateverTheCovariance) {
  // It comes into reach after 0.3 s, while its poses are rejected.
  EXPECT_LT(Restart({.way_m = 25.0, .gap_s = 0.1, .grows = false}).error_m(), 0.01);
  EXPECT_LT(Restart({.way_m = 25.0, .gap_s = 0.2, .grows = false}).error_m(), 0.01);
}

/// One message of a node that lost its way, and its next ones.
TEST(OdometryOrigin, IsNotMisledByOneEmptyPose) {
  OdometryOrigin origin(70.0);
  for (int i = 0; i < 60; ++i) {
    OdometryPose odometry = told(i);
    if (i == 30) odometry.odom_from_base.setIdentity(), odometry.covariance.setZero();
    const auto taken = origin.take(odometry);
    EXPECT_EQ(taken.odometry.has_value(), i != 30) << i;
    if (!taken.odometry) continue;
    EXPECT_TRUE(taken.odometry->odom_from_base.isApprox(told(i).odom_from_base, 0.0)) << i;
  }
}

TEST(OdometryOrigin, KeepsTheUncertaintyOfThePathBeforeARestart) {
  OdometryOrigin origin(70.0);
  for (int i = 0; i < 500; ++i) origin.take(told(i));
  OdometryPose last;
  for (int i = 500; i < 520; ++i) {
    if (const auto taken = origin.take(told(i, 0.0, 500)); taken.odometry) last = *taken.odometry;
  }
  // A yaw error acts on the path since then: 4 m in the gap and after it.
  const double yaw_rad2 = told(499).covariance(5, 5);
  EXPECT_NEAR(last.covariance(0, 0), told(499).covariance(0, 0) + 16e-4, 1e-3);
  EXPECT_NEAR(last.covariance(1, 1), told(499).covariance(1, 1) + yaw_rad2 * 16.0, 0.1 * yaw_rad2 * 16.0);
}

/// What an odometry states of a vehicle that drives 30 m away from its origin, turns by 2 rad, and returns, twice.
template <class Covariance>
int restarts_seen_in(const Covariance& covariance, double gap_s = 0.0) {
  OdometryOrigin origin(70.0);
  int restarts = 0;
  double time_s = 0.0;
  for (int i = 0; i < 800; ++i) {
    time_s += 0.04 + (i % 75 == 60 ? gap_s : 0.0);
    const double share = 0.5 - 0.5 * std::cos(2.0 * M_PI * time_s / 16.0);
    OdometryPose odometry;
    odometry.stamp_ns = vision::to_ns(time_s);
    odometry.odom_from_base.translation().x() = 30.0 * share;
    odometry.odom_from_base.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 2.0 * share));
    odometry.covariance = covariance(i) * vision::Matrix6d::Identity();
    const auto taken = origin.take(odometry);
    restarts += taken.is_new_origin ? 1 : 0;
    EXPECT_TRUE(taken.odometry) << i << ": " << taken.reason;
  }
  return restarts;
}

TEST(OdometryOrigin, TakesNoCovarianceOfAnySortForARestart) {
  for (const double gap_s : {0.0, 3.0}) {
    EXPECT_EQ(restarts_seen_in([](int i) { return 1e-4 * (i + 1); }, gap_s), 0) << "grows";
    EXPECT_EQ(restarts_seen_in([](int) { return 1e-2; }, gap_s), 0) << "is constant";
    EXPECT_EQ(restarts_seen_in([](int) { return 0.0; }, gap_s), 0) << "is unknown";
    EXPECT_EQ(restarts_seen_in([](int i) { return 1e-4 * (i % 40 + 1); }, gap_s), 0) << "shrinks as loops are closed";
    EXPECT_EQ(restarts_seen_in([](int i) { return i % 2 == 0 ? 1e-5 : 1e-2; }, gap_s), 0) << "is of each step";
  }
}

/// After frames that were not measured, the covariance shrinks where the camera finds its last keyframe again.
TEST(OdometryOrigin, TakesNoEndOfUnmeasuredMotionForARestart) {
  OdometryOrigin origin(70.0);
  for (int i = 0; i < 60; ++i) {
    OdometryPose odometry = told(i);
    odometry.is_reliable = i < 10 || i >= 40;
    if (!odometry.is_reliable) odometry.covariance *= 1.0 + 100.0 * (i - 9);
    if (i >= 40) odometry.odom_from_base.translation().x() = 2.0;  // it had stopped at once
    const auto taken = origin.take(odometry);
    ASSERT_TRUE(taken.odometry) << i << ": " << taken.reason;
    EXPECT_FALSE(taken.is_new_origin) << i;
  }
}

}  // namespace
}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/gnss_trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "gnss_drive.hpp"

namespace panvo::localizer {
namespace {

/// A trial over a path, with fixes as changed.
GnssTrial trial_over(
    int steps, const std::function<void(GnssFix&)>& change = [](GnssFix&) {}) {
  GnssDrive drive(3, 1.0, 0.5);
  GnssTrial trial;
  for (int i = 1; i <= steps; ++i) {
    OdometrySample at{drive.step(), static_cast<double>(i)};
    GnssFix fix = drive.fix();
    change(fix);
    if (i % 5 == 0) trial.add({fix, at}, 30.0);
  }
  return trial;
}

TEST(GnssTrial, WaitsForAPathThatShowsTheDirection) {
  EXPECT_FALSE(trial_over(25).result(30.0));
  EXPECT_TRUE(trial_over(40).result(30.0));
}

TEST(GnssTrial, ReachesOverThePathThatIsNeededHoweverCloseTheFixesAre) {
  constexpr double kSigma_m = 10.0;  // 100 m of path show the direction
  GnssDrive drive(3, 1.0, kSigma_m);
  GnssTrial trial;
  for (int i = 1; i <= 400; ++i) {
    const OdometrySample at{drive.step(), static_cast<double>(i)};
    trial.add({drive.fix(), at}, 30.0);
    EXPECT_LE(trial.samples().size(), 64U);
    EXPECT_EQ(trial.samples().back().at.way_m, i);
    // Of a path with bends, 120 m are needed.
    if (i < 100 || i >= 120) {
      EXPECT_EQ(trial.result(30.0).has_value(), i >= 120) << i;
    }
  }
  const auto& samples = trial.samples();
  EXPECT_LT(samples.back().at.way_m - samples.front().at.way_m, 220.0);  // old ones are forgotten
  for (std::size_t k = 1; k < samples.size(); ++k) EXPECT_LE(samples[k].at.way_m - samples[k - 1].at.way_m, 8.0);
}

TEST(GnssTrial, FindsTheFrameOfTheSatellites) {
  const auto result = trial_over(200).result(30.0);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->agrees) << result->reason;
  // In the frame of the drive's start: turned by 2.1 rad, from 120 m east, 40 m south.
  const Eigen::Isometry3d enu_from_odom = result->odom_from_enu.inverse();
  EXPECT_NEAR(yaw_of(enu_from_odom.linear()), 2.1, 0.02);
  EXPECT_LT((enu_from_odom.translation().head<2>() - Eigen::Vector2d(120.0, -40.0)).norm(), 2.0);
}

TEST(GnssTrial, RefusesExchangedAxesAndAFixThatDoesNotMove) {
  const auto mirrored = trial_over(200, [](GnssFix& fix) { std::swap(fix.enu_m.x(), fix.enu_m.y()); }).result(30.0);
  ASSERT_TRUE(mirrored);
  EXPECT_FALSE(mirrored->agrees);
  const auto frozen = trial_over(200, [](GnssFix& fix) { fix.enu_m = Eigen::Vector3d(5.0, 5.0, 0.0); }).result(30.0);
  ASSERT_TRUE(frozen);
  EXPECT_FALSE(frozen->agrees);
  EXPECT_THAT(frozen->reason, ::testing::HasSubstr("differs from the odometry's"));
  EXPECT_THAT(frozen->reason, ::testing::HasSubstr("; 0 m long"));
}

TEST(GnssTrial, RefusesFixesThatAreWorseThanTheySay) {
  int i = 0;
  const auto noisy =
      trial_over(200, [&i](GnssFix& fix) { fix.enu_m.x() += i++ / 5 % 2 == 0 ? 5.0 : -5.0; }).result(30.0);
  ASSERT_TRUE(noisy);
  EXPECT_FALSE(noisy->agrees);
}

}  // namespace
}  // namespace panvo::localizer

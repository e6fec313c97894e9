// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "drive.hpp"

namespace panvo::odometry_fusion {
namespace {

constexpr double kLearned_s = 40.0;  // two turns

/// Largest differences of the predicted motion since the latest fused pose to the true one.
struct Worst {
  double position_m = 0.0, rotation_rad = 0.0, ahead_s = 0.0, nees_sum = 0.0;
  int count = 0;
};

Worst predict(Drive options) {
  options.duration_s = 90.0;
  options.stereo_delay_ms = 100;
  Worst worst;
  std::vector<std::pair<std::int64_t, Eigen::Isometry3d>> truths;  // by stamp
  options.watch = [&](const OdometryFusion& fusion, double t_s, const Eigen::Isometry3d& truth) {
    truths.emplace_back(Simulator::stamp(t_s), truth);
    const auto predicted = fusion.predicted();
    if (!predicted || t_s < kLearned_s) return;
    EXPECT_NEAR(seconds(Simulator::stamp(t_s), predicted->stamp_ns), 0.0, 0.001);  // error of the learned clock
    const std::int64_t from_ns = fusion.latest()->stamp_ns;
    const auto from = std::ranges::find(truths, from_ns, &std::pair<std::int64_t, Eigen::Isometry3d>::first);
    ASSERT_NE(from, truths.end());
    const Eigen::Isometry3d error = (from->second.inverse() * truth).inverse() *
                                    (fusion.latest()->odom_from_base.inverse() * predicted->odom_from_base);
    worst.position_m = std::max(worst.position_m, error.translation().norm());
    worst.rotation_rad = std::max(worst.rotation_rad, vision::so3_log(error.linear()).norm());
    worst.ahead_s = std::max(worst.ahead_s, seconds(from_ns, predicted->stamp_ns));
    worst.nees_sum += Outcome{t_s, truth, {}, {}, *predicted}.nees();
    ++worst.count;
  };
  drive(options);
  return worst;
}

TEST(Prediction, FollowsGyroscopeAndWheelsAheadOfTheCameras) {
  const Worst worst = predict({.motion = town});
  EXPECT_EQ(worst.count, 10001);  // 200 Hz
  EXPECT_NEAR(worst.ahead_s, 0.14, 0.021);
  EXPECT_LT(worst.position_m, 0.035);     // 0.7 m of random walk by 1 cm/sqrt(m), four sigma
  EXPECT_LT(worst.rotation_rad, 1.5e-3);  // white noise, and a bias known to 5e-4 rad/s; 3e-3 without gyroscope
  EXPECT_LT(worst.nees_sum / worst.count, 2.0);
}

TEST(Prediction, KeepsTheVelocityWithoutWheels) {
  const Worst worst = predict({.motion = town, .has_wheels = false});
  EXPECT_EQ(worst.count, 10001);
  EXPECT_LT(worst.position_m, 0.06);  // braking by 1 m/s^2 for 0.16 s, and the noise of the cameras
  EXPECT_LT(worst.rotation_rad, 1.5e-3);
}

TEST(Prediction, EndsHalfASecondAfterTheLastPose) {
  OdometryFusion fusion({});
  drive({.duration_s = 40.0, .motion = town, .has_wheels = false}, fusion);
  const std::int64_t end_ns = fusion.latest()->stamp_ns;
  for (int i = 1; i < 200; ++i) {
    const std::int64_t stamp_ns = end_ns + i * 5'000'000L + 2'500'000L;  // the learned clock errs by less
    fusion.add(GyroSample{stamp_ns, Eigen::Vector3d(1e-4 * (i % 3), 0.0, 0.0), 0.0});
    const auto predicted = fusion.predicted();
    EXPECT_EQ(predicted.has_value(), seconds(end_ns, stamp_ns) < 0.5) << i;
  }
}

TEST(Prediction, KeepsAStandingVehicleWhereItIs) {
  Drive options{.duration_s = 70.0, .motion = [](double t_s) { return t_s < 60.0 ? town(t_s) : TrueMotion{}; }};
  int standing = 0;
  options.watch = [&](const OdometryFusion& fusion, double t_s, const Eigen::Isometry3d&) {
    const auto predicted = fusion.predicted();
    if (!predicted || t_s < 62.0) return;
    standing += predicted->is_standing;
    EXPECT_EQ(predicted->odom_from_base.matrix(), fusion.latest()->odom_from_base.matrix()) << t_s;
  };
  drive(options);
  EXPECT_GT(standing, 1200);  // of 1,600 samples in 8 s; those that coincide with a fused pose have no prediction
}

}  // namespace
}  // namespace panvo::odometry_fusion

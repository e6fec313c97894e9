// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/odometry_fusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "drive.hpp"

namespace panvo::odometry_fusion {
namespace {

/// Error of the motion between two times.
double error_between_m(const std::vector<Outcome>& outcomes, double from_s, double to_s) {
  const auto at = [&](double t_s) -> const Outcome& {
    return *std::ranges::find_if(outcomes, [&](const Outcome& one) { return one.t_s > t_s - 0.01; });
  };
  const auto& from = at(from_s);
  const auto& to = at(to_s);
  return ((from.fused.odom_from_base.inverse() * to.fused.odom_from_base).translation() -
          (from.truth.inverse() * to.truth).translation())
      .norm();
}

TEST(OdometryFusion, IsTheStereoOdometryWithoutOtherSensors) {
  const Drive options{.duration_s = 30.0,
                      .motion = town,
                      .has_gyro = false,
                      .has_wheels = false,
                      .blind_from_s = 20.0,
                      .blind_to_s = 22.0};
  const auto outcomes = drive(options);
  ASSERT_EQ(outcomes.size(), 751U);
  for (const auto& one : outcomes) {
    EXPECT_LT((one.fused.odom_from_base.translation() - one.stereo.translation()).norm(), 1e-5);
    EXPECT_EQ(one.fused.is_reliable, one.t_s < 20.01 || one.t_s > 22.01) << one.t_s;
  }
}

TEST(OdometryFusion, LearnsBiasesScalesAndClocks) {
  OdometryFusion fusion({});
  const Drive options{.motion = town, .gyro_late_s = 0.006, .wheels_late_s = -0.02};
  drive(options, fusion);
  const auto expect = [&](int learned, double truth) {
    EXPECT_NEAR(fusion.filter().learned()[learned], truth, 3.0 * fusion.filter().sigma(learned)) << learned;
  };
  for (int axis = 0; axis < 3; ++axis) expect(kGyroBias + axis, options.gyro_bias[axis]);
  expect(kGyroScale, 0.002);
  expect(kGyroClock, 0.006);
  expect(kWheelScale, options.wheel_scale - 1.0);
  expect(kWheelYawScale, options.wheel_yaw_scale - 1.0);
  EXPECT_NEAR(fusion.wheels_late_s(), -0.02, 0.02);
  EXPECT_LT(fusion.filter().sigma(kGyroBias + 2), 5e-4);
  EXPECT_LT(fusion.filter().sigma(kGyroClock), 1e-3);
  EXPECT_LT(fusion.filter().sigma(kWheelScale), 5e-3);
}

TEST(OdometryFusion, BridgesTenSecondsWithoutImages) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const Drive options{.seed = seed, .motion = town, .blind_from_s = 100.0, .blind_to_s = 110.0};
    const auto outcomes = drive(options);
    EXPECT_LT(error_between_m(outcomes, 100.0, 110.0), 0.25) << "seed " << seed;
    for (const auto& one : outcomes) {
      if (one.t_s > 100.1 && one.t_s < 110.0) {
        EXPECT_TRUE(one.fused.is_reliable && one.fused.uses_wheels && one.fused.uses_gyro && !one.fused.uses_cameras);
      }
    }
  }
}

TEST(OdometryFusion, BridgesTheFirstTurnWithoutImages) {
  for (const bool has_gyro : {false, true}) {
    const Drive options{
        .duration_s = 13.0, .motion = town, .has_gyro = has_gyro, .blind_from_s = 6.5, .blind_to_s = 12.0};
    EXPECT_LT(error_between_m(drive(options), 6.0, 12.0), has_gyro ? 0.3 : 2.5) << "gyro " << has_gyro;
  }
}

TEST(OdometryFusion, ErrsAsItsCovarianceSays) {
  double driven = 0.0, blind = 0.0;
  constexpr unsigned kSeeds = 20;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    driven += drive({.seed = seed, .motion = town}).back().nees() / kSeeds;
    // Blind from the beginning of a turn, so that the error of the dead reckoning is most of all.
    const Drive options{.duration_s = 50.0, .seed = seed, .motion = town, .blind_from_s = 38.0, .blind_to_s = 50.0};
    blind += drive(options).back().nees() / kSeeds;
  }
  EXPECT_GT(driven, 0.5);
  EXPECT_LT(driven, 2.0);
  EXPECT_GT(blind, 0.5);
  EXPECT_LT(blind, 2.0);
}

TEST(OdometryFusion, IsBetterWithAGyroscope) {
  const auto error_m = [](bool has_gyro, bool has_wheels) {
    double sum = 0.0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      sum += rms_m(drive({.seed = seed, .motion = town, .has_gyro = has_gyro, .has_wheels = has_wheels})) / 10.0;
    }
    return sum;
  };
  const double stereo_m = error_m(false, false);
  const double with_wheels_m = error_m(false, true), with_both_m = error_m(true, true);
  EXPECT_NEAR(with_wheels_m, stereo_m, 0.05 * stereo_m);  // they count when the cameras fail
  EXPECT_LT(error_m(true, false), stereo_m);
  EXPECT_LT(with_both_m, stereo_m);
}

/// Standing for a minute after 20 s of driving.
TrueMotion stopping(double t_s) {
  const double moving = std::clamp((20.0 - t_s) / 3.0, 0.0, 1.0);
  TrueMotion motion = town(t_s > 80.0 ? t_s - 60.0 : t_s);
  if (t_s > 16.0 && t_s <= 80.0) {
    motion.forward_m_s *= moving;
    motion.rate_rad_s *= moving;
  }
  return motion;
}

TEST(OdometryFusion, DoesNotDriftWhileStanding) {
  Drive options{.duration_s = 78.0, .motion = stopping};
  // Moving objects drag the stereo odometry along.
  options.stereo_fault = [](double t_s, Eigen::Isometry3d& move) {
    if (t_s > 30.0 && t_s < 70.0) move.translation() += Eigen::Vector3d(0.05, 0.01, 0.0);
  };
  OdometryFusion fusion({});
  const auto outcomes = drive(options, fusion);
  const auto& begin = *std::ranges::find_if(outcomes, [](const Outcome& one) { return one.t_s > 21.0; });
  const auto& end = outcomes.back();
  ASSERT_GT((begin.stereo.translation() - end.stereo.translation()).norm(), 10.0);
  EXPECT_TRUE(end.fused.is_standing);
  EXPECT_LT((begin.fused.odom_from_base.translation() - end.fused.odom_from_base.translation()).norm(), 1e-9);
  EXPECT_TRUE(begin.fused.odom_from_base.linear().isApprox(end.fused.odom_from_base.linear(), 1e-9));
  EXPECT_NEAR(begin.fused.covariance.trace(), end.fused.covariance.trace(), 1e-9);
  for (int axis = 0; axis < 3; ++axis) {  // a minute at rest shows the bias
    EXPECT_NEAR(fusion.filter().learned()[kGyroBias + axis], options.gyro_bias[axis], 4e-4);
  }
}

TEST(OdometryFusion, SeesASuspensionSettleWhileWheelsStand) {
  Drive options{.duration_s = 40.0, .motion = [](double t_s) {
                  TrueMotion motion = stopping(t_s);
                  if (t_s > 30.0 && t_s < 31.0) motion.rate_rad_s.y() = 0.006;  // by 0.3 degrees
                  return motion;
                }};
  for (const bool has_gyro : {false, true}) {
    options.has_gyro = has_gyro;
    const auto outcomes = drive(options);
    const auto& before = outcomes[29 * 25];
    const auto& after = outcomes.back();
    const Eigen::Matrix3d turned =
        before.fused.odom_from_base.linear().transpose() * after.fused.odom_from_base.linear();
    EXPECT_NEAR(vision::so3_log(turned).y(), 0.006, 0.001) << "gyro " << has_gyro;
    EXPECT_LT((after.fused.odom_from_base.translation() - before.fused.odom_from_base.translation()).norm(), 0.01);
  }
}

TEST(OdometryFusion, RejectsSlip) {
  Drive options{.motion = town};
  const double without_m = rms_m(drive(options));
  const auto slipping = [](double t_s, WheelSample& sample) {
    if (t_s > 60.0 && t_s < 62.0) sample.forward_m_s += 5.0;
    if (t_s > 80.0 && t_s < 84.0) sample.forward_m_s *= 1.3;
  };
  const double usual_m = error_between_m(drive(options), 59.0, 63.0);
  options.wheel_fault = slipping;
  const auto outcomes = drive(options);
  EXPECT_LT(rms_m(outcomes), 1.05 * without_m);
  EXPECT_LT(error_between_m(outcomes, 59.0, 63.0), usual_m + 0.05);
}

TEST(OdometryFusion, OutvotesCamerasThatFollowMovingObjects) {
  Drive options{.motion = town};
  const double without_m = rms_m(drive(options));
  options.stereo_fault = [](double t_s, Eigen::Isometry3d& move) {
    if (t_s < 60.0 || t_s > 64.0) return;
    move.translation().x() += 0.2;
    move.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 0.02)) * move.linear();
  };
  EXPECT_LT(rms_m(drive(options)), without_m + 0.3);
}

TEST(OdometryFusion, ContinuesWhenStereoPosesStop) {
  OdometryFusion fusion({});
  const auto outcomes = drive({.duration_s = 60.0, .motion = town}, fusion);
  const auto& last = outcomes.back();
  const std::int64_t from_ns = last.fused.stamp_ns;
  std::optional<FusedPose> pose;
  for (int i = 1; i <= 400; ++i) {  // two seconds straight at 5 m/s
    const std::int64_t stamp_ns = from_ns + i * 5'000'000;
    fusion.add(GyroSample{stamp_ns, Eigen::Vector3d(0.004, -0.006, 0.01 + 1e-6 * i), 0.0});
    if (i % 4 == 0) fusion.add(WheelSample{stamp_ns, 5.0 / 1.01, 0.0, 0.0, 0.0, 0.0});
    while (const auto next = fusion.next()) pose = next;
  }
  ASSERT_TRUE(pose);
  const double moved_s = seconds(from_ns, pose->stamp_ns);
  EXPECT_GT(moved_s, 1.5);
  EXPECT_NEAR((last.fused.odom_from_base.inverse() * pose->odom_from_base).translation().x(), 5.0 * moved_s, 0.2);
  EXPECT_FALSE(pose->uses_cameras);
}

TEST(OdometryFusion, ContinuesWhenStereoPosesStopAlsoAfterAPauseOfAnHour) {
  OdometryFusion fusion({});
  const Outcome last = drive({.duration_s = 60.0, .motion = town}, fusion).back();
  StereoPose stereo{last.fused.stamp_ns, last.stereo, last.stereo_covariance, true};
  std::optional<FusedPose> pose;
  for (int i = 0; i < 800; ++i) {  // two seconds with stereo poses, and two without
    const std::int64_t stamp_ns = last.fused.stamp_ns + 3'600'000'000'000 + i * std::int64_t{5'000'000};
    fusion.add(GyroSample{stamp_ns, Eigen::Vector3d(0.004, -0.006, 0.01 + 1e-6 * i), 0.0});
    if (i % 4 == 0) fusion.add(WheelSample{stamp_ns, 5.0 / 1.01, 0.0, 0.0, 0.0, 0.0});
    if (i % 8 == 0 && i < 400) {
      stereo.stamp_ns = stamp_ns;
      stereo.odom_from_base = stereo.odom_from_base * Eigen::Translation3d(0.2, 0.0, 0.0);
      stereo.covariance += 1e-6 * vision::Matrix6d::Identity();
      fusion.add(stereo);
    }
    while (const auto next = fusion.next()) pose = next;
  }
  ASSERT_TRUE(pose);
  EXPECT_FALSE(pose->uses_cameras);
  EXPECT_GT(seconds(stereo.stamp_ns, pose->stamp_ns), 1.5);
}

TEST(OdometryFusion, DoesNotDependOnTheOrderOfArrival) {
  const auto run = [](bool is_shuffled) {
    OdometryFusion fusion({});
    std::vector<FusedPose> poses;
    std::vector<GyroSample> late;
    const auto collect = [&] {
      while (const auto pose = fusion.next()) poses.push_back(*pose);
    };
    Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = 1e-6 * vision::Matrix6d::Identity();
    for (int i = 0; i <= 4000; ++i) {
      const double t_s = 0.005 * i;
      const std::int64_t stamp_ns = i * std::int64_t{5'000'000};
      const TrueMotion now = town(t_s);
      late.push_back({stamp_ns, now.rate_rad_s + Eigen::Vector3d::Constant(1e-5 * (i % 7)), 0.0});
      if (late.size() == 8) {
        if (is_shuffled) std::swap(late[0], late[6]);
        if (is_shuffled) std::swap(late[2], late[3]);
        for (const auto& sample : late) fusion.add(sample);
        late.clear();
      }
      if (i % 4 == 0) fusion.add(WheelSample{stamp_ns, now.forward_m_s, 0.0, now.rate_rad_s.z(), 0.0, 0.0});
      if (i % 8 == 0) {
        covariance += 1e-8 * vision::Matrix6d::Identity();
        fusion.add(StereoPose{stamp_ns, truth, covariance, true});
      }
      collect();
      vision::Vector6d twist;
      twist << now.forward_m_s, 0.0, 0.0, now.rate_rad_s;
      truth = truth * vision::se3_exp(0.005 * twist);
    }
    return poses;
  };
  const auto in_order = run(false), shuffled = run(true);
  ASSERT_EQ(in_order.size(), shuffled.size());
  for (std::size_t i = 0; i < in_order.size(); ++i) {
    EXPECT_EQ(in_order[i].stamp_ns, shuffled[i].stamp_ns);
    EXPECT_EQ(in_order[i].odom_from_base.matrix(), shuffled[i].odom_from_base.matrix());
  }
}

TEST(OdometryFusion, RefusesWhatIsNotFiniteOrTooOld) {
  OdometryFusion fusion({});
  EXPECT_FALSE(fusion.add(GyroSample{1, Eigen::Vector3d::Constant(NAN), 0.0}));
  EXPECT_FALSE(fusion.add(WheelSample{1, INFINITY, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_TRUE(fusion.add(WheelSample{1, 1.0, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(fusion.add(WheelSample{1, 1.0, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_TRUE(fusion.add(StereoPose{.stamp_ns = 100}));
  EXPECT_FALSE(fusion.add(StereoPose{.stamp_ns = 100}));
}

}  // namespace
}  // namespace panvo::odometry_fusion

// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/motion_sensors.hpp"

#include <gtest/gtest.h>

namespace panvo::simulation {
namespace {

constexpr std::int64_t kPeriod_ns = 40'000'000;

/// 100 s at 5 m/s on a circle, 0.1 rad/s to the left.
MotionSensors::Samples circle(MotionSensors& sensors, int steps = 2500) {
  vision::Vector6d twist;
  twist << 5.0, 0.0, 0.0, 0.0, 0.0, 0.1;
  MotionSensors::Samples all;
  for (int i = 0; i <= steps; ++i) {
    const auto samples = sensors.step(i * kPeriod_ns, vision::se3_exp(i * 0.04 * twist));
    all.gyro.insert(all.gyro.end(), samples.gyro.begin(), samples.gyro.end());
    all.wheels.insert(all.wheels.end(), samples.wheels.begin(), samples.wheels.end());
  }
  return all;
}

TEST(MotionSensors, MeasureTheTrueMotionWithoutErrors) {
  MotionSensors sensors(
      {.noise_rad_s_sqrt_hz = 0.0, .bias_rad_s = 0.0, .bias_walk_rad_s2_sqrt_hz = 0.0, .scale_ratio = 0.0},
      {.noise_per_sqrt_m = 0.0,
       .yaw_noise_rad_per_sqrt_m = 0.0,
       .tick_m = 1e-6,
       .scale_ratio = 0.0,
       .yaw_scale_ratio = 0.0,
       .slips_per_km = 0.0},
      1);
  const auto samples = circle(sensors, 25);
  ASSERT_EQ(samples.gyro.size(), 200U);
  ASSERT_EQ(samples.wheels.size(), 50U);
  EXPECT_EQ(samples.gyro.front().stamp_ns, 5'000'000);
  EXPECT_EQ(samples.gyro.back().stamp_ns, 1'000'000'000);
  for (const auto& one : samples.gyro) EXPECT_TRUE(one.rate_rad_s.isApprox(Eigen::Vector3d(0.0, 0.0, 0.1), 1e-9));
  for (const auto& one : samples.wheels) {
    EXPECT_NEAR(one.forward_m_s, 5.0, 1e-4);
    EXPECT_NEAR(one.yaw_rate_rad_s, 0.1, 1e-9);
  }
}

TEST(MotionSensors, HaveTheStatedNoise) {
  const GyroErrors gyro{.bias_rad_s = 0.0, .bias_walk_rad_s2_sqrt_hz = 0.0, .scale_ratio = 0.0};
  MotionSensors sensors(gyro, {.scale_ratio = 0.0, .slips_per_km = 0.0}, 3);
  const auto samples = circle(sensors);
  double variance = 0.0;
  for (const auto& one : samples.gyro) variance += one.rate_rad_s.x() * one.rate_rad_s.x();
  variance /= static_cast<double>(samples.gyro.size());
  EXPECT_NEAR(std::sqrt(variance / gyro.rate_hz), gyro.noise_rad_s_sqrt_hz, 0.02 * gyro.noise_rad_s_sqrt_hz);
  double way_m = 0.0;
  for (const auto& one : samples.wheels) way_m += one.forward_m_s / 50.0;
  EXPECT_NEAR(way_m, 500.0, 4.0 * 0.008 * std::sqrt(500.0));  // a random walk
}

TEST(MotionSensors, CountWholeTicks) {
  MotionSensors sensors({}, {.tick_m = 0.01}, 1);
  for (const auto& one : circle(sensors, 100).wheels) {
    const double ticks = one.forward_m_s / 50.0 / 0.01;
    EXPECT_NEAR(ticks, std::round(ticks), 1e-6);
  }
}

TEST(MotionSensors, SlipAsOftenAsStated) {
  MotionSensors sensors({}, {.noise_per_sqrt_m = 0.0, .scale_ratio = 0.0, .slips_per_km = 20.0}, 2);
  int slips = 0;
  bool was_slipping = false;
  for (const auto& one : circle(sensors).wheels) {
    const bool is_slipping = one.forward_m_s > 5.3;
    slips += is_slipping && !was_slipping;
    was_slipping = is_slipping;
  }
  EXPECT_NEAR(slips, 10, 6);
}

TEST(MotionSensors, AreTheSameForTheSameSeed) {
  MotionSensors a({}, {}, 7), b({}, {}, 7), c({}, {}, 8);
  const auto of_a = circle(a, 50), of_b = circle(b, 50), of_c = circle(c, 50);
  EXPECT_EQ(of_a.gyro.back().rate_rad_s, of_b.gyro.back().rate_rad_s);
  EXPECT_EQ(of_a.wheels.back().forward_m_s, of_b.wheels.back().forward_m_s);
  EXPECT_NE(of_a.gyro.back().rate_rad_s, of_c.gyro.back().rate_rad_s);
}

}  // namespace
}  // namespace panvo::simulation

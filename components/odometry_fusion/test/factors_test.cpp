// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/factors.hpp"

#include <gtest/gtest.h>

namespace panvo::odometry_fusion {
namespace {

constexpr std::int64_t kTenth_ns = 100'000'000;

MotionFilter filter_with(const Eigen::Isometry3d& step, const LearnedVector& learned) {
  MotionFilter filter{FusionParameters{}};
  filter.begin_unknown(0.1);
  Factor known(6);  // sets the step
  known.residual.head<3>() = step.translation();
  known.residual.tail<3>() = vision::so3_log(step.linear());
  known.by_step.setIdentity();
  known.noise = 1e-14 * vision::Matrix6d::Identity();
  filter.update(known);
  filter.begin_unknown(0.1);  // predicts the same
  filter.restart(0, kLearned, learned, LearnedVector::Constant(1e-3));
  return filter;
}

Eigen::Isometry3d curve() {
  vision::Vector6d twist;
  twist << 0.6, 0.02, 0.01, 0.01, -0.02, 0.08;
  return vision::se3_exp(twist);
}

LearnedVector some_learned() {
  LearnedVector learned;
  learned << 0.01, -0.02, 0.03, 0.01, 0.02, -0.01, 0.02, 0.004, 0.03, -0.05, 0.4, 0.01, -0.02, 0.002, 0.001;
  return learned;
}

/// Compares the derivatives of a factor with differences of its residual.
template <class Make>
void expect_derivatives(const Make& make, double tolerance, const std::vector<int>& by_stamps = {}) {
  const Factor at = make(filter_with(curve(), some_learned()));
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 6; ++i) {
    Eigen::Isometry3d moved = curve();
    if (i < 3) moved.translation()[i] += kStep;
    if (i >= 3) moved.linear() = vision::so3_exp(kStep * Eigen::Vector3d::Unit(i - 3)) * moved.linear();
    const Factor there = make(filter_with(moved, some_learned()));
    EXPECT_LT(((at.residual - there.residual) / kStep - at.by_step.col(i)).norm(), tolerance) << "step " << i;
  }
  for (int i = 0; i < kLearned; ++i) {
    if (std::ranges::find(by_stamps, i) != by_stamps.end()) continue;
    LearnedVector learned = some_learned();
    learned[i] += kStep;
    const Factor there = make(filter_with(curve(), learned));
    EXPECT_LT(((at.residual - there.residual) / kStep - at.by_learned.col(i)).norm(), tolerance) << "learned " << i;
  }
}

std::vector<GyroSample> gyro_samples() {
  std::vector<GyroSample> samples;
  for (int i = 0; i <= 20; ++i) {
    samples.push_back({i * kTenth_ns / 20, Eigen::Vector3d(0.1, -0.2, 0.8) + 0.01 * i * Eigen::Vector3d(1, 1, 2), 0.0});
  }
  return samples;
}

std::vector<WheelSample> wheel_samples() {
  return {
      {0, 6.0, 0.1, 0.8, 0.0, 0.0}, {kTenth_ns / 2, 6.2, 0.1, 0.85, 0.0, 0.0}, {kTenth_ns, 6.3, 0.1, 0.9, 0.0, 0.0}};
}

TEST(Factors, HaveTheDerivativesOfTheirResiduals) {
  const vision::Matrix6d covariance = vision::Matrix6d::Identity();
  expect_derivatives([&](const auto& filter) { return stereo_factor(filter, curve(), covariance); }, 0.02);
  const auto gyro = gyro_samples();
  // Clocks act through the samples, which are chosen by them.
  expect_derivatives([&](const auto& filter) { return gyro_factor(filter, gyro, {}); }, 0.05, {kGyroClock});
  const auto wheels = wheel_samples();
  expect_derivatives([&](const auto& filter) { return wheel_factor(filter, wheels, {}, true); }, 0.06);
}

TEST(Factors, VanishForTheTrueMotion) {
  const Eigen::Vector3d rate(0.1, -0.2, 0.8);
  vision::Vector6d twist;
  twist << 6.0, 0.0, 0.0, rate;
  const Eigen::Isometry3d step = vision::se3_exp(0.1 * twist);
  LearnedVector learned = LearnedVector::Zero();
  learned[kGyroBias + 2] = 0.05;
  learned[kGyroScale] = 0.01;
  learned[kWheelScale] = 0.02;
  const MotionFilter filter = filter_with(step, learned);
  const Eigen::Vector3d shown = 1.01 * rate + Eigen::Vector3d(0.0, 0.0, 0.05);
  const std::vector<GyroSample> gyro{{0, shown, 0.0}, {kTenth_ns, shown, 0.0}};
  EXPECT_LT(gyro_factor(filter, gyro, {}).residual.norm(), 1e-9);
  const WheelSample rolling{0, 6.0 / 1.02, 0.0, 0.8, 0.0, 0.0};
  std::vector<WheelSample> wheels{rolling, rolling};
  wheels[1].stamp_ns = kTenth_ns;
  EXPECT_LT(wheel_factor(filter, wheels, {}, false).residual.norm(), 1e-4);
  EXPECT_LT(stereo_factor(filter, step, vision::Matrix6d::Identity()).residual.norm(), 1e-9);
}

TEST(Factors, OfClocksHaveTheDerivativeByLateSamples) {
  const MotionFilter filter = filter_with(curve(), LearnedVector::Zero());
  const auto rate = [](double t_s) { return Eigen::Vector3d(0.1, 0.2, 0.5 + 2.0 * t_s); };
  const auto samples = [&](double late_s) {
    return std::vector<GyroSample>{{0, rate(late_s), 0.0}, {kTenth_ns, rate(0.1 + late_s), 0.0}};
  };
  const Factor at = gyro_factor(filter, samples(0.0), {});
  const Factor late = gyro_factor(filter, samples(1e-3), {});
  // A clock estimate that grows by 1 ms selects samples 1 ms later.
  EXPECT_LT(((at.residual - late.residual) / 1e-3 - at.by_learned.col(kGyroClock)).norm(), 0.02);
}

}  // namespace
}  // namespace panvo::odometry_fusion

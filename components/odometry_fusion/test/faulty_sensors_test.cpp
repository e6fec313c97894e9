// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "drive.hpp"

namespace panvo::odometry_fusion {
namespace {

struct GyroFault {
  const char* name;
  std::function<void(double t_s, GyroSample&)> apply;
  const char* diagnosis;  // part of it; empty: tolerated without one
};

struct WheelFault {
  const char* name;
  std::function<void(double t_s, WheelSample&)> apply;
  const char* diagnosis;
};

constexpr double kDegrees = 180.0 / M_PI;

const GyroFault kGyroFaults[] = {
    {"Degrees", [](double, GyroSample& s) { s.rate_rad_s *= kDegrees; }, "degrees"},
    {"UpsideDown",
     [](double, GyroSample& s) {
       s.rate_rad_s = Eigen::Vector3d(s.rate_rad_s.x(), -s.rate_rad_s.y(), -s.rate_rad_s.z());
     },
     "upside down"},
    {"AxesSwapped",
     [](double, GyroSample& s) {
       s.rate_rad_s = Eigen::Vector3d(s.rate_rad_s.z(), s.rate_rad_s.x(), s.rate_rad_s.y());
     },
     "axis x"},
    {"Stuck",
     [](double t, GyroSample& s) {
       if (t > 3.0) s.rate_rad_s = Eigen::Vector3d(0.01, 0.0, 0.02);
     },
     "stuck"},
    {"DiesLater",
     [](double t, GyroSample& s) {
       if (t > 60.0) s.rate_rad_s.setZero();
     },
     ""},
    {"LateBySeconds", [](double, GyroSample& s) { s.stamp_ns += 3'000'000'000; }, ""},
    {"LateByHalfASecond", [](double, GyroSample& s) { s.stamp_ns += 400'000'000; }, ""},
    {"TwoOnOneTopic",
     [](double t, GyroSample& s) {
       if (std::lround(t * 200.0) % 2 == 1) s.rate_rad_s *= -1.0;
     },
     "do not follow"},
    {"HugeNoise", [](double t, GyroSample& s) { s.rate_rad_s.array() += 0.5 * std::sin(1e5 * t * t); }, ""},
    {"WrongScale", [](double, GyroSample& s) { s.rate_rad_s *= 1.12; }, "1.12 times"},
    {"Saturated", [](double, GyroSample& s) { s.rate_rad_s = s.rate_rad_s.cwiseMin(0.2).cwiseMax(-0.2); }, ""},
    {"JumpingBias",
     [](double t, GyroSample& s) {
       if (t > 70.0) s.rate_rad_s.z() += 0.05;
     },
     ""},
    {"AGapOfThirtySeconds",
     [](double t, GyroSample& s) {
       if (t > 50.0 && t < 80.0) s.stamp_ns = 0;
     },
     ""},
};

const WheelFault kWheelFaults[] = {
    {"Reversed", [](double, WheelSample& s) { s.forward_m_s *= -1.0; }, "opposite sign"},
    {"KilometresPerHour", [](double, WheelSample& s) { s.forward_m_s *= 3.6; }, "km/h"},
    {"Dead", [](double, WheelSample& s) { s.forward_m_s = s.yaw_rate_rad_s = 0.0; }, "near 0"},
    {"DiesLater",
     [](double t, WheelSample& s) {
       if (t > 60.0) s.forward_m_s = s.yaw_rate_rad_s = 0.0;
     },
     "near 0"},
    {"YawReversed", [](double, WheelSample& s) { s.yaw_rate_rad_s *= -1.0; }, "opposite sign"},
    {"YawInDegrees", [](double, WheelSample& s) { s.yaw_rate_rad_s *= kDegrees; }, "degrees"},
    {"LateByHalfASecond", [](double, WheelSample& s) { s.stamp_ns += 400'000'000; }, "late"},
    {"StuckAtSpeed",
     [](double t, WheelSample& s) {
       if (t > 20.0) s.forward_m_s = 4.0;
     },
     ""},
    {"WrongRadius", [](double, WheelSample& s) { s.forward_m_s *= 1.12; }, ""},
    {"HugeNoise", [](double t, WheelSample& s) { s.forward_m_s += 3.0 * std::sin(1e5 * t * t); }, ""},
    {"NoCovarianceAndAbsurdOne", [](double, WheelSample& s) { s.forward_variance = s.yaw_variance = 1e9; }, ""},
    {"AGapOfThirtySeconds",
     [](double t, WheelSample& s) {
       if (t > 50.0 && t < 80.0) s.stamp_ns = 0;
     },
     ""},
    {"SpinsAtEachStart",
     [](double t, WheelSample& s) {
       if (std::fmod(t, 15.0) > 12.0 && std::fmod(t, 15.0) < 14.0) s.forward_m_s *= 1.6;
     },
     ""},
};

class FaultyGyro : public testing::TestWithParam<GyroFault> {};
class FaultyWheels : public testing::TestWithParam<WheelFault> {};

constexpr double kAtMost = 1.2;
constexpr unsigned kSeeds = 2;

/// Root mean square error of drives with several seeds; `look` gets each fusion at its end.
double error_m(Drive options, const std::function<void(const OdometryFusion&)>& look = {}) {
  double sum = 0.0;
  for (options.seed = 1; options.seed <= kSeeds; ++options.seed) {
    OdometryFusion fusion({});
    sum += std::pow(rms_m(drive(options, fusion)), 2) / kSeeds;
    if (look) look(fusion);
  }
  return std::sqrt(sum);
}

void expect_fault(const std::string& fault, const std::string& part) {
  EXPECT_NE(fault.find(part), std::string::npos) << "'" << fault << "' lacks '" << part << "'";
}

TEST_P(FaultyGyro, IsNamedAndDoesNoHarm) {
  for (const bool has_wheels : {false, true}) {
    Drive options{.motion = town, .has_gyro = false, .has_wheels = has_wheels};
    static std::map<bool, double> without;  // the same for each fault
    if (!without.contains(has_wheels)) without[has_wheels] = error_m(options);
    options.has_gyro = true;
    options.gyro_fault = GetParam().apply;
    const double with_m =
        error_m(options, [](const auto& fusion) { expect_fault(fusion.gyro().fault, GetParam().diagnosis); });
    EXPECT_LT(with_m, kAtMost * without[has_wheels]) << "wheels " << has_wheels;
  }
}

TEST_P(FaultyWheels, AreNamedAndDoNoHarm) {
  for (const bool has_gyro : {false, true}) {
    Drive options{.motion = town, .has_gyro = has_gyro, .has_wheels = false};
    static std::map<bool, double> without;
    if (!without.contains(has_gyro)) without[has_gyro] = error_m(options);
    options.has_wheels = true;
    options.wheel_fault = GetParam().apply;
    const double with_m = error_m(options, [](const auto& fusion) {
      expect_fault(fusion.wheels().fault + fusion.wheel_yaw().fault, GetParam().diagnosis);
    });
    EXPECT_LT(with_m, kAtMost * without[has_gyro]) << "gyro " << has_gyro;
  }
}

INSTANTIATE_TEST_SUITE_P(All, FaultyGyro, testing::ValuesIn(kGyroFaults),
                         [](const auto& one) { return std::string(one.param.name); });
INSTANTIATE_TEST_SUITE_P(All, FaultyWheels, testing::ValuesIn(kWheelFaults),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(FaultySensors, AreUsedAgainWhenTheirClockThatWasAheadIsSetBack) {
  int predicted = 0;
  Drive options{.duration_s = 60.0, .motion = town, .stereo_delay_ms = 20};
  options.gyro_fault = [](double t_s, GyroSample& sample) {
    if (t_s > 40.0 && t_s < 41.0) sample.stamp_ns += 600'000'000'000;
  };
  options.wheel_fault = [](double t_s, WheelSample& sample) {
    if (t_s > 40.0 && t_s < 41.0) sample.stamp_ns += 600'000'000'000;
  };
  options.watch = [&](const OdometryFusion& fusion, double t_s, const Eigen::Isometry3d&) {
    predicted += t_s > 42.0 && fusion.predicted();
  };
  int used = 0;
  for (const auto& one : drive(options)) used += one.t_s > 42.0 && one.fused.uses_gyro && one.fused.uses_wheels;
  EXPECT_GT(predicted, 17 * 200) << "of 18 s at 200 Hz";
  EXPECT_GT(used, 17 * 25) << "of 18 s at 25 Hz";
}

}  // namespace
}  // namespace panvo::odometry_fusion

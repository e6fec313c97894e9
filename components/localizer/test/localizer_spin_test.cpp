// SPDX-License-Identifier: Apache-2.0
// The localizer of a vehicle that turns in place, by more than 180 degrees against one reference panorama.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "panvo/localizer/localizer.hpp"
#include "panvo/vision/angle.hpp"

namespace panvo::localizer {
namespace {

/// Odometry at 25 Hz that turns too much by some share, and exact panoramas at 5 Hz, each of which is the reference for
/// five seconds.
class Spin {
 public:
  Spin(double rate_deg_s, double too_much) : rate_rad_s_(rate_deg_s * vision::kDegree), too_much_(too_much) {
    localizer_.add(odometry_);
  }

  void turn(int seconds, bool has_panoramas) {
    for (int i = 0; i < 25 * seconds; ++i) step(has_panoramas);
  }

  double true_rad() const { return rate_rad_s_ * 0.04 * frame_; }
  double odometry_error_rad() const { return too_much_ * true_rad(); }
  /// Not wrapped, as the error of a good localizer is a fraction of the turn.
  double error_rad() const { return yaw_rad_ - true_rad(); }

 private:
  static constexpr std::int64_t kFrame_ns = 40'000'000;
  static constexpr int kFramesAPanorama = 5, kFramesAReference = 125;
  static constexpr double kStepSigma_rad = 2e-4, kPanoramaSigma_rad = 2e-3;

  static Parameters one_clock() {
    Parameters parameters;
    parameters.clock_sigma_s = 0.0;
    return parameters;
  }

  void step(bool has_panorama) {
    ++frame_;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.linear() = vision::so3_exp({0.0, 0.0, (1.0 + too_much_) * rate_rad_s_ * 0.04});
    const vision::Matrix6d gained = kStepSigma_rad * kStepSigma_rad * vision::Matrix6d::Identity();
    odometry_.covariance = vision::compose_covariance(odometry_.odom_from_base, odometry_.covariance, move, gained);
    odometry_.odom_from_base = odometry_.odom_from_base * move;
    odometry_.stamp_ns = frame_ * kFrame_ns;
    localizer_.add(odometry_);
    if (has_panorama && frame_ % kFramesAPanorama == 0) {
      const int reference = (frame_ - 1) / kFramesAReference * kFramesAReference;
      localizer_.add(AzimuthMeasurement{reference * kFrame_ns, frame_ * kFrame_ns,
                                        vision::wrapped(rate_rad_s_ * 0.04 * (frame_ - reference)),
                                        kPanoramaSigma_rad * kPanoramaSigma_rad});
    }
    yaw_rad_ += vision::wrapped(yaw_of(localizer_.latest().map_from_base.linear()) - yaw_rad_);
  }

  const double rate_rad_s_, too_much_;
  Localizer localizer_{one_clock()};
  OdometryPose odometry_;
  int frame_ = 0;
  double yaw_rad_ = 0.0;
};

/// Rate, deg/s, left positive.
class LocalizerThatTurnsInPlace : public testing::TestWithParam<double> {};

TEST_P(LocalizerThatTurnsInPlace, IsBetterThanOdometryThatTurnsTooMuchOrTooLittle) {
  for (const double too_much : {0.002, 0.015, -0.015}) {
    Spin spin(GetParam(), too_much);
    spin.turn(60, true);
    const double share = spin.error_rad() / spin.odometry_error_rad();
    EXPECT_GT(share, 0.0) << too_much;
    EXPECT_LT(share, 0.8) << too_much;
  }
}

TEST_P(LocalizerThatTurnsInPlace, LearnsWhetherOdometryTurnsTooMuchOrTooLittle) {
  for (const double too_much : {0.002, 0.015, -0.015}) {
    Spin spin(GetParam(), too_much);
    spin.turn(60, true);
    const double before_rad = spin.error_rad(), odometry_before_rad = spin.odometry_error_rad();
    spin.turn(20, false);
    const double share = (spin.error_rad() - before_rad) / (spin.odometry_error_rad() - odometry_before_rad);
    EXPECT_GT(share, 0.0) << too_much;
    EXPECT_LT(share, 0.8) << too_much;
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, LocalizerThatTurnsInPlace,
                         testing::Values(10.0, 20.0, 45.0, 70.0, -10.0, -20.0, -45.0, -70.0),
                         [](const auto& of) { return "At" + std::to_string(of.index); });

}  // namespace
}  // namespace panvo::localizer

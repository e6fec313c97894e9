// SPDX-License-Identifier: Apache-2.0
// The localizer with odometry that turns too far by an angle per metre which changes, while the compass falls silent.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {
namespace {

constexpr double kLeanSigma = 1.4e-4;              // rad/m
constexpr double kLeanLasts = 0.007 / kLeanSigma;  // m

/// A straight drive at 5 m/s, whose odometry has hardly another error.
class ChangingLean {
 public:
  explicit ChangingLean(unsigned seed) : random_(seed), lean_rad_m_(kLeanSigma * noise()), localizer_(parameters()) {
    odometry_.lean_sigma_rad_per_m = kLeanSigma;
    localizer_.add(odometry_);
  }

  void drive(int metres, bool has_compass) {
    const double same = std::exp(-1.0 / kLeanLasts);
    for (int i = 1; i <= metres; ++i) {
      lean_rad_m_ = same * lean_rad_m_ + std::sqrt(1.0 - same * same) * kLeanSigma * noise();
      Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
      step.translation().x() = 1.0;
      step.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, lean_rad_m_));
      const vision::Matrix6d gained = 1e-8 * vision::Matrix6d::Identity();
      odometry_.covariance = vision::compose_covariance(odometry_.odom_from_base, odometry_.covariance, step, gained);
      odometry_.odom_from_base = odometry_.odom_from_base * step;
      odometry_.stamp_ns += kPair_ns;
      localizer_.add(odometry_);
      if (!has_compass || i % kEach != 0) continue;
      const double turn_rad = kCompass_rad * noise();
      localizer_.add(AzimuthMeasurement{odometry_.stamp_ns - kEach * kPair_ns, odometry_.stamp_ns, turn_rad,
                                        kCompass_rad * kCompass_rad});
    }
  }

  double yaw_rad() const { return yaw_of(localizer_.latest().map_from_base.linear()); }
  double yaw_variance_rad2() const { return localizer_.latest().covariance(vision::kYaw, vision::kYaw); }

 private:
  static constexpr std::int64_t kPair_ns = 200'000'000;
  static constexpr int kEach = 4;  // steps between panoramas
  static constexpr double kCompass_rad = 5e-4;

  static Parameters parameters() {
    Parameters parameters;
    parameters.clock_sigma_s = parameters.turn_scale_sigma = parameters.scale_sigma = 0.0;
    return parameters;
  }

  double noise() { return normal_(random_); }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double lean_rad_m_;
  OdometryPose odometry_;
  Localizer localizer_;
};

TEST(LocalizerWithALean, KnowsHowWellItKnowsTheHeadingWhileTheCompassIsSilent) {
  constexpr int kJourneys = 200, kSilent_m = 80;
  double nees = 0.0;
  for (unsigned seed = 0; seed < kJourneys; ++seed) {
    ChangingLean journey(seed);
    journey.drive(200, true);
    const double before_rad = journey.yaw_rad(), before_rad2 = journey.yaw_variance_rad2();
    journey.drive(kSilent_m, false);
    const double turned_rad = journey.yaw_rad() - before_rad;
    nees += turned_rad * turned_rad / (journey.yaw_variance_rad2() - before_rad2) / kJourneys;
  }
  RecordProperty("nees", std::to_string(nees));
  EXPECT_NEAR(nees, 1.0, 0.4);
}

TEST(LocalizerWithALean, IsNoSurerOfTheHeadingBecauseTheCompassIsBack) {
  ChangingLean journey(1);
  journey.drive(200, true);
  journey.drive(80, false);
  const double silent_rad2 = journey.yaw_variance_rad2();
  journey.drive(200, true);  // tells nothing of the turns of before
  EXPECT_GT(journey.yaw_variance_rad2(), 0.6 * silent_rad2);
}

}  // namespace
}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "gnss_drive.hpp"
#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {
namespace {

/// Fixes over 300 m, then an outage in which a landmark is built. The scale of the odometry is drawn for each drive.
class Outage {
 public:
  explicit Outage(unsigned seed) : random_(seed), drive_(seed, 1.0 + kScaleSigma * normal_(random_), 0.5) {
    localizer_.add(drive_.now());
    go(300, true);
  }

  void go(int steps, bool has_fixes) {
    for (int i = 1; i <= steps; ++i) {
      localizer_.add(drive_.step());
      if (has_fixes && i % 5 == 0) localizer_.add(drive_.fix());
    }
  }

  void build() {
    place_ = drive_.truth;
    ASSERT_TRUE(localizer_.add_built(1, drive_.stamp_ns()));
  }

  void see() {
    constexpr double kSigma_m = 0.05, kSigma_rad = 0.002;
    LandmarkSighting sighting;
    sighting.stamp_ns = drive_.stamp_ns();
    sighting.landmark_id = 1;
    sighting.landmark_from_base = place_.inverse() * drive_.truth;
    sighting.landmark_from_base.translation() += kSigma_m * noise();
    sighting.landmark_from_base.linear() = vision::so3_exp(kSigma_rad * noise()) * sighting.landmark_from_base.linear();
    sighting.covariance.topLeftCorner<3, 3>() = kSigma_m * kSigma_m * Eigen::Matrix3d::Identity();
    sighting.covariance.bottomRightCorner<3, 3>() = kSigma_rad * kSigma_rad * Eigen::Matrix3d::Identity();
    const auto correction = localizer_.add(sighting);
    EXPECT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  }

  /// Normalised squared error of the horizontal position, per axis.
  double nees_of_pose() const {
    return position_nees(localizer_.latest().map_from_base, drive_.truth, localizer_.latest().covariance);
  }
  double nees_of_place() const {
    const auto landmark = localizer_.landmarks().front();
    return position_nees(landmark.map_from_base, place_, landmark.covariance);
  }

 private:
  static constexpr double kScaleSigma = 0.005;

  static Parameters of_scale() {
    Parameters parameters;
    parameters.scale_sigma = kScaleSigma;
    return parameters;
  }

  Eigen::Vector3d noise() {
    const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
    return {x, y, z};
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  GnssDrive drive_;
  Localizer localizer_{of_scale()};
  Eigen::Isometry3d place_ = Eigen::Isometry3d::Identity();
};

TEST(LocalizerInAnOutage, KnowsHowWellItKnowsLandmarksThatWereBuiltInIt) {
  constexpr int kTrials = 20;
  double built = 0.0, seen = 0.0, pose = 0.0;
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    Outage outage(seed);
    outage.go(1000, false);
    outage.build();
    built += outage.nees_of_place() / kTrials;
    outage.go(500, false);
    outage.go(200, true);
    outage.see();
    seen += outage.nees_of_place() / kTrials;
    pose += outage.nees_of_pose() / kTrials;
  }
  RecordProperty("built", std::to_string(built));
  RecordProperty("seen", std::to_string(seen));
  RecordProperty("pose", std::to_string(pose));
  // 40 degrees of freedom: a fair covariance gives 0.61 to 1.48 in 95 of 100 cases.
  for (const double nees : {built, seen, pose}) {
    EXPECT_GT(nees, 0.4);
    EXPECT_LT(nees, 1.48);
  }
}

}  // namespace
}  // namespace panvo::localizer

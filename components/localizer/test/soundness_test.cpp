// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/soundness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "drive.hpp"

namespace panvo::localizer {
namespace {

const double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(FaultOf, IsNothingForWhatOdometrySays) {
  Drive drive(1);
  for (int i = 0; i < 300; ++i) drive.step();
  EXPECT_FALSE(fault_of(drive.now().odom_from_base, drive.now().covariance));
  EXPECT_FALSE(fault_of(Eigen::Isometry3d::Identity(), vision::Matrix6d::Zero())) << "many publish no covariance";
}

/// Poses with one fault each.
std::vector<std::pair<Eigen::Isometry3d, vision::Matrix6d>> unsound() {
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const vision::Matrix6d covariance = 1e-4 * vision::Matrix6d::Identity();
  std::vector<std::pair<Eigen::Isometry3d, vision::Matrix6d>> all(9, {pose, covariance});
  all[0].first.translation().x() = kNone;
  all[1].first.translation().x() = 1e200;
  all[2].first.linear()(0, 0) = 2.0;
  all[3].second(2, 2) = kNone;
  all[4].second(2, 2) = std::numeric_limits<double>::infinity();
  all[5].second *= 1e308;
  all[6].second(1, 1) = -1.0;
  all[7].second(0, 1) = all[7].second(1, 0) = 1.0;  // a correlation above 1
  all[8].second(0, 1) = 1e-4;
  return all;
}

TEST(FaultOf, NamesWhatIsWrong) {
  for (const auto& [pose, covariance] : unsound()) EXPECT_TRUE(fault_of(pose, covariance)) << covariance;
}

TEST(FaultOf, NamesAnAngleThatNoCompassMeasures) {
  EXPECT_FALSE(fault_of_angle(0.1, 1e-6));
  for (const auto& [angle, variance] : std::vector<std::pair<double, double>>{
           {kNone, 1e-6}, {0.1, kNone}, {0.1, 0.0}, {0.1, -1.0}, {0.1, 1e-300}, {0.1, 1e300}, {1e9, 1e-6}}) {
    EXPECT_TRUE(fault_of_angle(angle, variance)) << angle << ' ' << variance;
  }
}

TEST(Localizer, IsNotChangedByInputThatHasAFault) {
  Round round(21);
  const auto before = round.localizer.latest();
  const auto is_the_same = [&] {
    const auto& now = round.localizer.latest();
    return now.map_from_base.matrix() == before.map_from_base.matrix() && now.covariance == before.covariance &&
           now.state == before.state;
  };
  for (const auto& [pose, covariance] : unsound()) {
    auto next = round.drive.now();
    next.stamp_ns += kPeriod_ns;
    next.odom_from_base = pose;
    next.covariance = covariance;
    round.localizer.add(next);
    EXPECT_TRUE(is_the_same()) << covariance;
    auto sighting = round.drive.sight(1, round.landmark);
    sighting.landmark_from_base = pose;
    sighting.covariance = covariance;
    EXPECT_EQ(round.localizer.add(sighting).kind, CorrectionKind::kRejected);
    EXPECT_FALSE(round.localizer.set_initial_pose({pose, covariance}, round.drive.now().stamp_ns)) << covariance;
    KnownLandmark known;
    known.id = 7;
    known.map_from_base = pose;
    known.covariance = covariance;
    EXPECT_FALSE(round.localizer.add_known(known));
    EXPECT_TRUE(is_the_same()) << covariance;
  }
  EXPECT_EQ(round.localizer.add(round.drive.azimuth(0.03, 1e-150)), AzimuthUse::kNotUsed);
  EXPECT_TRUE(is_the_same());
  round.localizer.add(round.drive.step());
  EXPECT_EQ(round.localizer.add(round.drive.sight(1, round.landmark)).kind, CorrectionKind::kApplied);
}

}  // namespace
}  // namespace panvo::localizer

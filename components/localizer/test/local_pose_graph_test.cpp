// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/local_pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "drive.hpp"

namespace panvo::localizer {
namespace {

constexpr double kLap_m = 200.0;

Eigen::Isometry3d at_x(double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)); }

vision::Matrix6d variance(double sigma) { return sigma * sigma * vision::Matrix6d::Identity(); }

/// A vehicle on repeated laps. Odometry returns 0.1 m farther ahead after each lap, with a covariance of that size.
OdometrySample in_lap(int lap) {
  OdometrySample at;
  at.pose.stamp_ns = 1'000'000'000LL * (1 + 40 * lap);
  at.pose.odom_from_base = at_x(0.1 * lap);
  at.pose.covariance = variance(0.1 * std::sqrt(lap + 1.0));
  at.way_m = kLap_m * (1 + lap);
  return at;
}

LandmarkSighting sighting_in_lap(int lap) {
  LandmarkSighting sighting;
  sighting.stamp_ns = in_lap(lap).pose.stamp_ns;
  sighting.landmark_id = 1;
  sighting.landmark_from_base = at_x(0.0);
  sighting.covariance = variance(lap == 3 ? 0.01 : 0.02);
  return sighting;
}

TEST(LocalPoseGraph, StaysSmallWhereOneRouteIsDrivenAllDay) {
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  graph.start({});
  graph.add_built(1, in_lap(0).pose.stamp_ns, in_lap(0));
  std::size_t after_ten = 0;
  for (int lap = 1; lap <= 60; ++lap) {
    ASSERT_TRUE(graph.add_pass(sighting_in_lap(lap), in_lap(lap), 20.0)) << lap;
    ASSERT_TRUE(graph.solve()) << lap;
    if (lap == 10) after_ten = graph.size();
  }
  EXPECT_EQ(graph.size(), after_ten);
  // The last sighting removes the drift of 60 laps down to the error of the landmark and a sighting.
  const auto here = graph.carried(in_lap(60));
  EXPECT_LT(here.map_from_base.translation().norm(), 0.3);
}

/// On the way of a straight journey.
OdometrySample at_metre(double x_m) {
  OdometrySample sample;
  sample.way_m = x_m;
  sample.pose = {static_cast<std::int64_t>(x_m * 1e8), at_x(x_m), variance(0.01 * std::sqrt(x_m)), true};
  return sample;
}

/// A journey of 250 landmarks 10 m apart, with a sighting of the 200th at its end.
TEST(LocalPoseGraph, RenewsTheCovariancesNearTheVehicleInALargeMap) {
  constexpr int kLandmarks = 250;
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  graph.start(at_metre(0.0));
  for (int i = 1; i <= kLandmarks; ++i) graph.add_built(static_cast<std::uint32_t>(i), 0, at_metre(10.0 * i));
  const auto sigma_m = [&](std::uint32_t id) { return std::sqrt(graph.landmark(id)->covariance(0, 0)); };
  const double far_m = sigma_m(20), near_m = sigma_m(245);
  LandmarkSighting sighting;
  sighting.stamp_ns = at_metre(10.0 * kLandmarks + 5.0).pose.stamp_ns;
  sighting.landmark_id = 200;
  sighting.landmark_from_base = at_x(10.0 * (kLandmarks - 200) + 5.0);
  sighting.covariance = variance(0.001);
  ASSERT_TRUE(graph.add_pass(sighting, at_metre(10.0 * kLandmarks + 5.0), 20.0));
  ASSERT_TRUE(graph.solve());
  EXPECT_LT(sigma_m(245), 0.98 * near_m);  // better known by the sighting
  EXPECT_EQ(sigma_m(20), far_m);           // of another part of the map
}

/// A straight journey past stored landmarks, each of which tells where it is to 0.01 m and 0.01 rad.
class PastStoredLandmarks : public testing::Test {
 protected:
  PastStoredLandmarks() {
    graph.start(at_metre(0.0));
    graph.set_direction_sigma(kDirectionSigma_rad);
  }

  void pass(std::uint32_t id, double x_m) {
    graph.add_known({id, -1, at_x(x_m), variance(kMapSigma)});
    LandmarkSighting sighting;
    sighting.stamp_ns = at_metre(x_m).pose.stamp_ns;
    sighting.landmark_id = id;
    sighting.covariance = variance(0.001);
    ASSERT_TRUE(graph.add_pass(sighting, at_metre(x_m), 20.0));
    ASSERT_TRUE(graph.solve());
  }

  double common_sigma_m(double x_m, Eigen::Index axis) const {
    return std::sqrt(graph.common_covariance(at_metre(x_m))(axis, axis));
  }

  static constexpr double kScaleSigma = 0.002, kDirectionSigma_rad = 0.005, kMapSigma = 0.01;
  LocalPoseGraph graph{0.01, 0.001, kScaleSigma, {}};
};

TEST_F(PastStoredLandmarks, ScaleDirectionAndTheHeadingOfTheMapCountFromTheLastOne) {
  pass(1, 100.0);
  pass(2, 200.0);
  EXPECT_NEAR(common_sigma_m(200.0, 0), kMapSigma, 1e-3);
  EXPECT_NEAR(common_sigma_m(1200.0, 0), 1000.0 * kScaleSigma, 0.1);
  EXPECT_NEAR(common_sigma_m(1200.0, 1), 1000.0 * std::hypot(kDirectionSigma_rad, kMapSigma), 0.1);
}

TEST_F(PastStoredLandmarks, ALandmarkOfThisJourneyIsKnownByTheNextOfThem) {
  pass(1, 100.0);
  graph.add_built(7, at_metre(120.0).pose.stamp_ns, at_metre(120.0));
  pass(2, 2000.0);
  EXPECT_LT(std::sqrt(graph.common_covariance(7)(1, 1)), 0.5);
  graph.add_built(8, at_metre(1900.0).pose.stamp_ns, at_metre(1900.0));
  EXPECT_LT(std::sqrt(graph.common_covariance(8)(1, 1)), 1.5);
}

TEST_F(PastStoredLandmarks, FixesInAFrameWithAKnownPlaceShowTheDirectionToo) {
  pass(1, 100.0);
  EXPECT_GT(graph.since_known(at_metre(1100.0))(1, 1), 0.0);
  graph.set_enu(at_x(0.0), variance(0.001));
  GnssFix fix;
  fix.enu_m.x() = 1100.0;
  graph.add_fix(fix, at_metre(1100.0));
  EXPECT_EQ(graph.since_known(at_metre(1100.0))(1, 1), 0.0);
}

/// Between an external pose after the vehicle was lifted, and the next stored landmark.
TEST_F(PastStoredLandmarks, ScaleAndDirectionCountFromAnExternalPoseUntilTheNextOne) {
  pass(1, 100.0);
  pass(2, 200.0);
  graph.cut(at_metre(1200.0).pose.stamp_ns);
  graph.set_initial_pose({at_x(1200.0), variance(0.1)}, at_metre(1200.0));
  ASSERT_TRUE(graph.solve());
  EXPECT_NEAR(common_sigma_m(1220.0, 1), 20.0 * kDirectionSigma_rad, 1e-2);
  EXPECT_NEAR(std::sqrt(graph.since_known(at_metre(1220.0))(1, 1)), 20.0 * kDirectionSigma_rad, 1e-2);
  EXPECT_NEAR(common_sigma_m(1190.0, 1), 990.0 * std::hypot(kDirectionSigma_rad, kMapSigma), 0.1) << "before";
  pass(3, 1240.0);
  EXPECT_NEAR(common_sigma_m(1220.0, 1), std::hypot(kMapSigma, 20.0 * std::hypot(kDirectionSigma_rad, kMapSigma)), 1e-2)
      << "errors of the stored map";
}

/// Nodes with equal stamps, and in no order of time.
TEST_F(PastStoredLandmarks, TheCommonErrorsOfAllLandmarksAreThoseOfEachAlone) {
  graph.cut(at_metre(71.0).pose.stamp_ns);
  graph.set_initial_pose({at_x(80.0), variance(0.1)}, at_metre(80.0));
  for (const bool has_fixes : {false, true}) {
    if (has_fixes) graph.set_enu(at_x(0.0), variance(0.001));
    const std::uint32_t first = has_fixes ? 101 : 1;
    for (std::uint32_t i = 0; i < 60; ++i) {
      const double x_m = 10.0 * ((i * 7) % 30) + (has_fixes ? 5.0 : 0.0);  // each place twice
      graph.add_built(first + i, at_metre(x_m).pose.stamp_ns, at_metre(x_m));
      if (i % 13 == 5) pass(1000 + first + i, x_m + (i % 2 == 0 ? 0.0 : 4.0));
      if (has_fixes && i % 11 == 3) graph.add_fix({}, at_metre(x_m));
    }
    const auto all = graph.common_errors();
    ASSERT_EQ(all.size(), has_fixes ? 120U : 60U);
    for (const auto& [id, errors] : all) EXPECT_EQ(errors.covariance, graph.common_covariance(id)) << id;
  }
}

TEST(LocalPoseGraph, SaysWhereItCannotBeSolved) {
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  graph.start({});
  KnownLandmark known;
  known.id = 1;
  known.covariance = variance(std::nan(""));
  graph.add_known(known);
  ASSERT_TRUE(graph.add_pass(sighting_in_lap(1), in_lap(1), 20.0));
  EXPECT_FALSE(graph.solve());
}

/// After a crash with a last pose that is too old, 5 m from where the vehicle is: a lap with a landmark at metre 20, in
/// the map of earlier landmarks. The drive begins at (50, 20) m of it, turned by 0.7 rad.
struct RestartedLap {
  RestartedLap() {
    map_from_drive.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 0.7));
    map_from_drive.translation() << 50.0, 20.0, 0.0;
    localizer.add(drive.now());
    localizer.add_known({9, -1, map_from_drive, variance(0.01)});
    localizer.forget_start(PoseInMap{at_x(45.0), variance(1.0)}, "restarted after a crash");
    for (int i = 1; i <= 219; ++i) {
      localizer.add(drive.step());
      if (i != 20) continue;
      landmark = drive.truth;
      localizer.add_built(1, drive.now().stamp_ns);
    }
  }

  double error_by_m(const Eigen::Isometry3d& map_from_start) const {
    return (localizer.latest().map_from_base.translation() - map_from_start * drive.truth.translation()).norm();
  }

  Eigen::Isometry3d map_from_drive = Eigen::Isometry3d::Identity(), landmark;
  Drive drive{3};
  Localizer localizer{of_known_scale()};
};

TEST(LocalPoseGraph, AppliesLandmarksOfAJourneyWhoseStartIsOnlyGuessed) {
  RestartedLap lap;
  EXPECT_GT(lap.error_by_m(at_x(45.0)), 2.0);  // drift of the odometry since the guessed start
  const auto correction = lap.localizer.add(lap.drive.sight(1, lap.landmark));
  EXPECT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  EXPECT_LT(lap.error_by_m(at_x(45.0)), 0.5);
  EXPECT_EQ(lap.localizer.latest().state, State::kUnlocated);
}

TEST(LocalPoseGraph, PutsAJourneyWhoseStartWasGuessedWhereStoredLandmarksShowIt) {
  RestartedLap lap;
  ASSERT_EQ(lap.localizer.add(lap.drive.sight(1, lap.landmark)).kind, CorrectionKind::kApplied);
  lap.localizer.add(lap.drive.sight(9, Eigen::Isometry3d::Identity()));
  lap.localizer.add(lap.drive.step());
  const auto correction = lap.localizer.add(lap.drive.sight(9, Eigen::Isometry3d::Identity()));
  EXPECT_EQ(correction.kind, CorrectionKind::kApplied) << correction.reason;
  EXPECT_LT(lap.error_by_m(lap.map_from_drive), 0.2);
  EXPECT_EQ(lap.localizer.latest().state, State::kRelocalised);
  const auto built = lap.localizer.landmarks().front();
  EXPECT_EQ(built.id, 1U);
  EXPECT_LT((built.map_from_base.translation() - lap.map_from_drive * lap.landmark.translation()).norm(), 0.5);
}

/// After a kilometre, the only thing that is known of a pose is what was said.
TEST(LocalPoseGraph, CountsScaleAndDirectionFromAnExternalPose) {
  constexpr double kScale = 0.01, kDirection_rad = 0.02, kSaid_m = 0.1;
  LocalPoseGraph graph(0.01, 0.001, kScale, {});
  graph.set_direction_sigma(kDirection_rad);
  graph.start(at_metre(0.0));
  const auto across_m = [&](double x_m) { return std::sqrt(graph.common_covariance(at_metre(x_m))(1, 1)); };
  EXPECT_NEAR(across_m(1000.0), 1000.0 * kDirection_rad, 1e-9) << "from the start";
  const PoseInMap said{at_x(1000.0), variance(kSaid_m)};
  graph.place(Eigen::Isometry3d::Identity());
  graph.set_initial_pose(said, at_metre(1000.0));
  ASSERT_TRUE(graph.solve());
  EXPECT_NEAR(across_m(1000.0), 0.0, 1e-3);
  EXPECT_NEAR(across_m(1100.0), 100.0 * kDirection_rad, 1e-3);
  EXPECT_NEAR(across_m(800.0), 200.0 * kDirection_rad, 1e-3) << "before";
  EXPECT_NEAR(std::sqrt(graph.common_covariance(at_metre(1100.0))(0, 0)), 100.0 * kScale, 0.03);
}

TEST(LocalPoseGraph, CountsScaleAndDirectionFromTheStartBeforeTheVehicleWasLifted) {
  constexpr double kDirection_rad = 0.02;
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  graph.set_direction_sigma(kDirection_rad);
  graph.start(at_metre(0.0));
  graph.add_built(1, at_metre(900.0).pose.stamp_ns, at_metre(900.0));
  graph.cut(at_metre(1000.0).pose.stamp_ns);
  graph.set_initial_pose({at_x(1000.0), variance(0.1)}, at_metre(1000.0));
  ASSERT_TRUE(graph.solve());
  const auto across_m = [&](double x_m) { return std::sqrt(graph.common_covariance(at_metre(x_m))(1, 1)); };
  EXPECT_NEAR(across_m(900.0), 900.0 * kDirection_rad, 1e-2);
  EXPECT_NEAR(across_m(1100.0), 100.0 * kDirection_rad, 1e-2);
  LandmarkSighting sighting;
  sighting.stamp_ns = at_metre(1050.0).pose.stamp_ns;
  sighting.landmark_id = 1;
  sighting.landmark_from_base = at_x(150.0);
  sighting.covariance = variance(0.02);
  ASSERT_TRUE(graph.add_pass(sighting, at_metre(1050.0), 20.0));
  ASSERT_TRUE(graph.solve());
  EXPECT_NEAR(across_m(1100.0), 1100.0 * kDirection_rad, 0.1) << "of its landmark";
}

TEST(LocalPoseGraph, CountsTheErrorOfASingleStoredLandmarkOnce) {
  constexpr double kStored_m = 0.5, kSighting_m = 0.02;
  LocalPoseGraph graph(0.01, 0.001, 0.0, {});
  graph.start(at_metre(0.0));
  const auto see = [&](std::uint32_t id, double x_m) {
    graph.add_known({id, 0, at_x(x_m), vision::Vector6d{0.25, 0.25, 0.25, 1e-6, 1e-6, 1e-6}.asDiagonal()});
    LandmarkSighting sighting;
    sighting.stamp_ns = at_metre(x_m).pose.stamp_ns;
    sighting.landmark_id = id;
    sighting.covariance = variance(kSighting_m);
    graph.place(Eigen::Isometry3d::Identity());
    EXPECT_TRUE(graph.add_pass(sighting, at_metre(x_m), 20.0));
    EXPECT_TRUE(graph.solve());
    return std::sqrt(graph.carried(at_metre(x_m)).covariance(1, 1) + graph.common_covariance(at_metre(x_m))(1, 1));
  };
  EXPECT_NEAR(see(1, 10.0), kStored_m, 0.01);
  EXPECT_GT(see(2, 60.0), kStored_m) << "errors of one map are alike";
}

}  // namespace
}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "panvo/localizer/localizer.hpp"
#include "winding_drive.hpp"

namespace panvo::localizer {
namespace {

constexpr double kStraightSpeed = 7.0;  // m/s
constexpr int kPlaces = 8;
constexpr double kSpacing_m = 7.0;

/// A vehicle on a straight road of a stored map, whose panoramas are stamped late. Everything else is exact.
class OnAStraightRoad {
 public:
  explicit OnAStraightRoad(double late_s, double clock_sigma_s = 0.05) : late_s_(late_s), localizer(of(clock_sigma_s)) {
    for (std::uint32_t id = 1; id <= kPlaces; ++id) {
      localizer.add_known({id, 1, Eigen::Isometry3d(Eigen::Translation3d(kSpacing_m * id, 0.0, 0.0)),
                           1e-4 * vision::Matrix6d::Identity()});
    }
  }

  /// Sees each place twice as it passes.
  void drive() {
    for (int frame = 0; frame <= 10 * (kPlaces + 1); ++frame) {
      localizer.add(OdometryPose{ns(0.1 * frame), at(0.1 * frame), 1e-6 * (frame + 1) * vision::Matrix6d::Identity()});
      if (frame < 10) continue;
      const double taken_s = 0.1 * frame - 0.5;
      if (frame % 10 > 1) continue;
      see(static_cast<std::uint32_t>(frame / 10), taken_s);
    }
  }

  double off_m() const {
    const auto& here = localizer.latest();
    return here.map_from_base.translation().x() - kStraightSpeed * 1e-9 * static_cast<double>(here.stamp_ns);
  }
  double sigma_ahead_m() const { return std::sqrt(localizer.latest().covariance(0, 0)); }
  double sigma_aside_m() const { return std::sqrt(localizer.latest().covariance(1, 1)); }

 private:
  static Parameters of(double clock_sigma_s) {
    Parameters parameters;
    parameters.clock_sigma_s = clock_sigma_s;
    return parameters;
  }
  static std::int64_t ns(double time_s) { return std::llround(1e9 * time_s); }
  static Eigen::Isometry3d at(double time_s) {
    return Eigen::Isometry3d(Eigen::Translation3d(kStraightSpeed * time_s, 0.0, 0.0));
  }

  void see(std::uint32_t place, double taken_s) {
    if (place == 0 || place > kPlaces) return;
    LandmarkSighting sighting;
    sighting.stamp_ns = ns(taken_s + late_s_);
    sighting.landmark_id = place;
    sighting.landmark_from_base = Eigen::Translation3d(-kSpacing_m * place, 0.0, 0.0) * at(taken_s);
    sighting.covariance = 1e-4 * vision::Matrix6d::Identity();
    localizer.add(sighting);
  }

  double late_s_;

 public:
  Localizer localizer;
};

TEST(LocalizerWithLatePanoramas, KnowsOnAStraightRoadOfAStoredMapThatTheyMayBeLate) {
  for (const double late_s : {0.05, 0.15, -0.1}) {
    OnAStraightRoad road(late_s);
    road.drive();
    ASSERT_EQ(road.localizer.latest().state, State::kTracking);
    EXPECT_NEAR(road.off_m(), -kStraightSpeed * late_s, 0.02) << "nothing shows it";
    EXPECT_LT(std::abs(road.off_m()), 3.3 * road.sigma_ahead_m());
    EXPECT_LT(road.sigma_ahead_m(), 1.5 * kStraightSpeed * 0.05);
    EXPECT_LT(road.sigma_aside_m(), 0.25) << "which the clock does not change";
  }
}

TEST(LocalizerWithLatePanoramas, KnowsThePositionAheadWithOneClock) {
  OnAStraightRoad road(0.0, 0.0);
  road.drive();
  ASSERT_EQ(road.localizer.latest().state, State::kTracking);
  EXPECT_LT(road.sigma_ahead_m(), 0.05);
}

SelfCalibration of_late_panoramas(double ahead_s) {
  SelfCalibration measured;
  measured.panorama_ahead_s = Estimate{ahead_s, 0.004};
  return measured;
}

TEST(LocalizerWithLatePanoramas, KnowsOnAStraightRoadThatTheyAreAsLateAsOnTheLastJourney) {
  constexpr double kAgo_s = 0.3;
  OnAStraightRoad first_day(kAgo_s), second_day(kAgo_s + 0.02);
  second_day.localizer.set_self_calibration(of_late_panoramas(kAgo_s));
  first_day.drive();
  second_day.drive();
  EXPECT_LT(first_day.off_m(), -0.9 * kStraightSpeed * kAgo_s) << "nothing shows it";
  EXPECT_NEAR(second_day.off_m(), -kStraightSpeed * 0.02, 0.02);
  EXPECT_NEAR(second_day.sigma_ahead_m(), first_day.sigma_ahead_m(), 0.01) << "it may have changed";
  EXPECT_FALSE(second_day.localizer.is_clock_known()) << "by this journey";
  EXPECT_FALSE(second_day.localizer.self_calibration().panorama_ahead_s);
}

TEST(LocalizerWithLatePanoramas, FindsThatTheyAreNotAsLateAsOnTheLastJourney) {
  for (const auto& [remembered_s, ahead_s] : {std::pair{0.3, 0.0}, std::pair{-1.0, 0.3}, std::pair{0.0, 1.5}}) {
    Winding vehicle;
    vehicle.localizer.set_self_calibration(of_late_panoramas(remembered_s));
    vehicle.step_variance = 5e-6;  // so that the compass counts
    vehicle.drive(0, 60, ahead_s);
    ASSERT_FALSE(vehicle.localizer.is_clock_known());
    vehicle.drive(60, 500, ahead_s);
    ASSERT_TRUE(vehicle.localizer.is_clock_known()) << ahead_s;
    EXPECT_NEAR(vehicle.localizer.panorama_clock().estimate_s(), ahead_s, 0.01);
    const auto& here = vehicle.localizer.latest();
    EXPECT_NEAR(yaw_of(here.map_from_base.linear()), Winding::yaw(Winding::time_s(499)), 0.002) << ahead_s;
    EXPECT_LT((here.map_from_base.translation() - Winding::at(Winding::time_s(499)).translation()).norm(), 0.02)
        << ahead_s;
    const auto measured = vehicle.localizer.self_calibration().panorama_ahead_s;
    ASSERT_TRUE(measured);
    EXPECT_NEAR(measured->value, ahead_s, 0.01);
  }
}

TEST(LocalizerWithLatePanoramas, TellsNothingOfAClockThatWasSet) {
  Winding vehicle;
  vehicle.drive(0, 500, 0.3);
  ASSERT_TRUE(vehicle.localizer.self_calibration().panorama_ahead_s);
  vehicle.localizer.set_clock_back(10'000'000'000);
  EXPECT_FALSE(vehicle.localizer.self_calibration().panorama_ahead_s);
}

TEST(LocalizerWithLatePanoramas, FusesTheTurnsFromBeforeTheirClockWasKnownAgain) {
  for (const double ahead_s : {0.3, 1.5, -1.5}) {
    Winding vehicle;
    vehicle.step_variance = 5e-6;  // so that the compass counts
    vehicle.drive(0, 500, ahead_s);
    ASSERT_TRUE(vehicle.localizer.is_clock_known()) << ahead_s;
    EXPECT_NEAR(vehicle.localizer.panorama_clock().estimate_s(), ahead_s, 0.01);
    const auto& here = vehicle.localizer.latest();
    EXPECT_NEAR(yaw_of(here.map_from_base.linear()), Winding::yaw(Winding::time_s(499)), 0.002) << ahead_s;
    EXPECT_LT((here.map_from_base.translation() - Winding::at(Winding::time_s(499)).translation()).norm(), 0.02)
        << "the path so far, too: " << ahead_s;
  }
}

/// Odometry turns too much, and several panoramas have one reference. The panoramic camera starts later.
TEST(LocalizerWithLatePanoramas, LearnsOfTheOdometryAsIfTheyWereNotLate) {
  for (const int first : {40, 600}) {
    const auto after_drive = [&](double ahead_s) {
      Winding vehicle;
      vehicle.step_variance = 1e-6;
      vehicle.panoramas_per_reference = 4;
      vehicle.first = first;
      vehicle.drive(0, 1400, ahead_s, [](double t) { return 0.03 * Winding::yaw(t) + 0.001 * (t - 100.0); });
      return vehicle.localizer.latest();
    };
    const auto late = after_drive(0.3), punctual = after_drive(0.0);
    EXPECT_NEAR(yaw_of(late.map_from_base.linear()), yaw_of(punctual.map_from_base.linear()), 0.001) << first;
    EXPECT_LT((late.map_from_base.translation() - punctual.map_from_base.translation()).norm(), 0.03) << first;
    EXPECT_NEAR(std::sqrt(late.covariance(5, 5) / punctual.covariance(5, 5)), 1.0, 0.05) << first;
  }
}

TEST(LocalizerWithLatePanoramas, UsesNoTurnsFromBeforeTheirClockWasKnownThatContradictTheOdometry) {
  Winding vehicle;
  vehicle.drive(0, 50, 0.0);
  vehicle.azimuth_error_rad = 0.15;
  vehicle.drive(50, 80, 0.0);
  ASSERT_FALSE(vehicle.localizer.is_clock_known());
  vehicle.azimuth_error_rad = 0.0;
  vehicle.drive(80, 500, 0.0);
  ASSERT_TRUE(vehicle.localizer.is_clock_known());
  const auto& here = vehicle.localizer.latest();
  EXPECT_NEAR(yaw_of(here.map_from_base.linear()), Winding::yaw(Winding::time_s(499)), 0.005);
  EXPECT_LT(std::sqrt(here.covariance(5, 5)), 0.01);
}

/// The latency of a stream changes by less than it is.
TEST(LocalizerWithLatePanoramas, DoubtsTheClockWhenALargeOffsetChanges) {
  Winding vehicle;
  vehicle.drive(0, 500, 1.5);
  ASSERT_TRUE(vehicle.localizer.is_clock_known());
  const std::size_t before = vehicle.uses.size();
  vehicle.drive(500, 1000, 1.2);
  const auto after = std::span(vehicle.uses).subspan(before);
  EXPECT_LE(std::ranges::count(after, AzimuthUse::kContradicted), 1) << "odometry is right";
  EXPECT_NEAR(vehicle.localizer.panorama_clock().estimate_s(), 1.2, 0.01);
}

TEST(LocalizerWithLatePanoramas, MakesLandmarksWhosePositionsMayBeOffAlongTheRoad) {
  Localizer localizer({});
  for (int frame = 0; frame <= 50; ++frame) {
    const Eigen::Isometry3d pose(Eigen::Translation3d(kStraightSpeed * 0.1 * frame, 0.0, 0.0));
    localizer.add(OdometryPose{100'000'000LL * frame, pose, 1e-8 * (frame + 1) * vision::Matrix6d::Identity()});
  }
  ASSERT_TRUE(localizer.add_built(1, 4'000'000'000));
  const auto covariance = localizer.landmarks().at(0).covariance;
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), kStraightSpeed * 0.05, 0.1 * kStraightSpeed * 0.05);
}

TEST(LocalizerWithLatePanoramas, KnowsThatASetClockHasNotDisplacedALandmarkOfBefore) {
  constexpr double kSet_s = 0.3, kBuilt_s = 117.0;
  constexpr int kSetAt = 500, kMost = 100;  // frames
  Winding vehicle;
  vehicle.drive(1, kSetAt - 10, 0.0);
  ASSERT_TRUE(vehicle.localizer.add_built(1, Winding::ns(kBuilt_s)));
  vehicle.drive(kSetAt - 10, kSetAt, 0.0);
  int frame = kSetAt;
  for (; vehicle.uses.back() != AzimuthUse::kUnclear && frame < kSetAt + kMost; ++frame) {
    vehicle.drive(frame, frame + 1, kSet_s);
  }
  ASSERT_EQ(vehicle.uses.back(), AzimuthUse::kUnclear);
  const double taken_s = Winding::time_s(frame - 1) - Winding::kLate_s;
  LandmarkSighting sighting;
  sighting.stamp_ns = Winding::ns(taken_s + kSet_s);
  sighting.landmark_id = 1;
  sighting.landmark_from_base = Winding::at(kBuilt_s).inverse() * Winding::at(taken_s);
  sighting.covariance = 1e-4 * vision::Matrix6d::Identity();
  EXPECT_EQ(vehicle.localizer.add(sighting).kind, CorrectionKind::kApplied)
      << "as the place of another time, but not much";
  const auto& here = vehicle.localizer.latest().map_from_base;
  EXPECT_LT((here.translation() - vehicle.odometry.odom_from_base.translation()).norm(), 0.05);
}

}  // namespace
}  // namespace panvo::localizer

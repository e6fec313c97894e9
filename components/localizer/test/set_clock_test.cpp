// SPDX-License-Identifier: Apache-2.0
// The odometry's clock is set during a journey.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "panvo/localizer/localizer.hpp"
#include "winding_drive.hpp"

namespace panvo::localizer {
namespace {

/// A vehicle at 2 m/s whose odometry's clock is set after 20 s.
struct ClockSetVehicle : Winding {
  ClockSetVehicle() {
    drive(0, 500, 0.0);
    sigma_before_m = sigma_m();
  }

  void set_clock_back(double by_s) {
    localizer.set_clock_back(ns(by_s));
    clock_back_s += by_s;
  }
  double sigma_m() const { return vision::horizontal_sigma(localizer.latest().covariance); }
  double error_m(int frame) const {
    return (localizer.latest().map_from_base.translation() - at(time_s(frame)).translation()).norm();
  }

  double sigma_before_m = 0.0;
};

TEST(LocalizerSetClock, IsUnsureOfTheStampsUntilTheFormerTimeIsBack) {
  constexpr double kBack_s = 1.5;
  ClockSetVehicle vehicle;
  vehicle.set_clock_back(kBack_s);
  vehicle.drive(500, 525, 0.0);
  EXPECT_LT(vehicle.error_m(524), 0.01) << "the path goes on";
  EXPECT_NEAR(vehicle.sigma_m(), kBack_s * Winding::kSpeed, 0.1) << "one of the two times is wrong";
  vehicle.set_clock_back(-kBack_s);
  vehicle.drive(525, 550, 0.0);
  EXPECT_LT(vehicle.sigma_m(), 1.5 * vehicle.sigma_before_m);
}

TEST(LocalizerSetClock, IsSureOfTheStampsOnceItIsKnownThatTheFormerTimeIsBack) {
  ClockSetVehicle vehicle;
  vehicle.set_clock_back(2.0);  // seems so by a message that came late
  vehicle.localizer.correct_set_back(Winding::ns(0.5));
  vehicle.drive(500, 525, 0.0);
  EXPECT_NEAR(vehicle.sigma_m(), 1.5 * Winding::kSpeed, 0.1);
  vehicle.set_clock_back(-1.0);
  vehicle.localizer.correct_set_back(Winding::ns(0.5));
  vehicle.drive(525, 550, 0.0);
  EXPECT_LT(vehicle.sigma_m(), 1.5 * vehicle.sigma_before_m);
}

TEST(LocalizerSetClock, KnowsWhereAStandingVehicleIsAtAnyTime) {
  Localizer localizer{Parameters{}};
  OdometryPose odometry;
  const auto stand = [&] {
    for (int i = 0; i < 50; ++i) {
      odometry.stamp_ns += 40'000'000;
      localizer.add(odometry);
    }
    return vision::horizontal_sigma(localizer.latest().covariance);
  };
  const double sigma_m = stand();
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  localizer.set_clock_back(-kHour_ns);
  odometry.stamp_ns += kHour_ns;
  EXPECT_NEAR(stand(), sigma_m, 1e-6);
}

TEST(LocalizerSetClock, TurnsShowThatBothCamerasClocksWereSet) {
  ClockSetVehicle vehicle, of_one_time;
  vehicle.set_clock_back(1.5);
  vehicle.drive(500, 1000, -1.5);
  of_one_time.drive(500, 1000, 0.0);
  EXPECT_LT(vehicle.error_m(999), 0.05);
  EXPECT_LT(vehicle.sigma_m(), 1.5 * of_one_time.sigma_m());
}

TEST(LocalizerSetClock, TurnsShowThatOnlyTheOdometrysClockWasSet) {
  constexpr double kBack_s = 1.5;
  ClockSetVehicle vehicle;
  vehicle.set_clock_back(kBack_s);
  vehicle.drive(500, 1000, 0.0);
  EXPECT_NEAR(vehicle.localizer.panorama_clock().estimate_s(), kBack_s, 0.02);
  EXPECT_NEAR(vehicle.sigma_m(), kBack_s * Winding::kSpeed, 0.2) << "still, one of the two is wrong";
}

TEST(LocalizerSetClock, IsSureOfStampsThatAreRightAllTheSame) {
  ClockSetVehicle vehicle;
  vehicle.set_clock_back(1.5);
  vehicle.drive(500, 510, 0.0);
  vehicle.localizer.trust_stamps();
  EXPECT_LT(vehicle.sigma_m(), 1.3 * vehicle.sigma_before_m);
}

TEST(LocalizerSetClock, APlaceMovesThePoseLittleUntilTurnsShowTheClocks) {
  constexpr double kBuilt_s = 116.0, kBack_s = 1.5;
  ClockSetVehicle vehicle;
  ASSERT_TRUE(vehicle.localizer.add_built(1, Winding::ns(kBuilt_s)));
  vehicle.set_clock_back(kBack_s);
  vehicle.first = 1000;  // no turns
  vehicle.drive(500, 600, 0.0);
  for (const double taken_s : {121.6, 121.8, 122.0}) {
    LandmarkSighting sighting{Winding::ns(taken_s), 1};  // by the panoramic camera's clock
    sighting.landmark_from_base = Winding::at(kBuilt_s).inverse() * Winding::at(taken_s);
    sighting.covariance = 1e-4 * vision::Matrix6d::Identity();
    vehicle.localizer.add(sighting);
  }
  EXPECT_LT(vehicle.error_m(599), 0.3);
  for (const auto& doubt : vehicle.localizer.doubts()) EXPECT_FALSE(doubt.forbids_use) << doubt.reason;
}

}  // namespace
}  // namespace panvo::localizer

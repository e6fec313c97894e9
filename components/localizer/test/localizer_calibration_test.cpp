// SPDX-License-Identifier: Apache-2.0
// What a journey measures of the sensors serves the next one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gnss_drive.hpp"
#include "panvo/localizer/localizer.hpp"
#include "panvo/vision/angle.hpp"
#include "winding_drive.hpp"

namespace panvo::localizer {
namespace {

/// Odometry turns a share too much.
double heading_error_rad(Winding& vehicle, int from, int to, double too_much) {
  double largest_rad = 0.0;
  for (int frame = from; frame < to; ++frame) {
    vehicle.drive(frame, frame + 1, 0.0, [&](double t) { return too_much * (Winding::yaw(t) - Winding::yaw(100.0)); });
    const double error_rad =
        yaw_of(vehicle.localizer.latest().map_from_base.linear()) - Winding::yaw(Winding::time_s(frame));
    largest_rad = std::max(largest_rad, std::abs(error_rad));
  }
  return largest_rad;
}

TEST(LocalizerSelfCalibration, ReducesTheErrorOfTurnsBeforeTheCompassShowsIt) {
  constexpr double kTooMuch = 0.006;
  constexpr int kFirstBends = 150, kNever = 1'000'000;
  Winding first_day;
  first_day.panoramas_per_reference = 4;
  heading_error_rad(first_day, 0, 3000, kTooMuch);
  const auto measured = first_day.localizer.self_calibration();
  ASSERT_TRUE(measured.turn_scale);
  EXPECT_NEAR(measured.turn_scale->value, kTooMuch, 3.0 * measured.turn_scale->sigma);
  EXPECT_LT(measured.turn_scale->sigma, 0.0015);

  Winding without, second_day;
  without.first = second_day.first = kNever;
  second_day.localizer.set_self_calibration(measured);
  const double before_rad = heading_error_rad(without, 0, kFirstBends, kTooMuch);
  EXPECT_LT(heading_error_rad(second_day, 0, kFirstBends, kTooMuch), 0.4 * before_rad);
  EXPECT_FALSE(second_day.localizer.self_calibration().turn_scale) << "not measured by this journey";
}

TEST(LocalizerSelfCalibration, RecoversFromAWrongErrorOfTurns) {
  SelfCalibration wrong;
  wrong.turn_scale = Estimate{0.006, 0.001};
  Winding without, with_wrong;
  for (auto* vehicle : {&without, &with_wrong}) vehicle->panoramas_per_reference = 4;
  with_wrong.localizer.set_self_calibration(wrong);
  const double usual_rad = heading_error_rad(without, 0, 1500, 0.006);
  EXPECT_LT(heading_error_rad(with_wrong, 0, 1500, 0.0), 1.2 * usual_rad);
  ASSERT_TRUE(with_wrong.localizer.self_calibration().turn_scale);
  EXPECT_NEAR(with_wrong.localizer.self_calibration().turn_scale->value, 0.0, 0.003);
}

TEST(LocalizerSelfCalibration, CorrectsDistancesWhereSatellitesDidOnAnEarlierJourney) {
  constexpr double kScale = 1.006;
  constexpr int kSteps = 1000;
  GnssDrive first(1, kScale, 0.05);
  Localizer first_day({});
  first_day.add(first.now());
  for (int i = 1; i <= kSteps; ++i) {
    first_day.add(first.step());
    if (i % 10 == 0) first_day.add(first.fix());
  }
  const auto measured = first_day.self_calibration();
  ASSERT_TRUE(measured.scale);
  EXPECT_NEAR(measured.scale->value, kScale, 0.001);
  EXPECT_FALSE(measured.panorama_ahead_s || measured.direction_rad || measured.turn_scale) << "no panoramas";

  GnssDrive second(2, kScale, 0.05);
  Localizer without({}), second_day({});
  second_day.set_self_calibration(measured);
  for (auto* localizer : {&without, &second_day}) localizer->add(second.now());
  for (int i = 1; i <= 100; ++i) {  // straight on: bends would add errors of turns
    const auto odometry = second.step();
    without.add(odometry);
    second_day.add(odometry);
    if (i == 50) {
      without.add_built(1, odometry.stamp_ns);
      second_day.add_built(1, odometry.stamp_ns);
    }
  }
  const auto length_error_m = [&](const Localizer& localizer) {
    return std::abs(localizer.latest().map_from_base.translation().norm() - second.truth.translation().norm());
  };
  EXPECT_GT(length_error_m(without), 0.4);
  EXPECT_LT(length_error_m(second_day), 0.2);
  EXPECT_NEAR(second_day.scale().value, measured.scale->value, 1e-12);
  EXPECT_FALSE(second_day.self_calibration().scale);
  // A landmark seen again has the graph solved, of which the scale remains a part.
  LandmarkSighting sighting;
  sighting.stamp_ns = second.stamp_ns();
  sighting.landmark_id = 1;
  sighting.landmark_from_base = second_day.landmarks()[0].map_from_base.inverse() * second_day.latest().map_from_base;
  sighting.covariance = vision::Matrix6d::Identity();
  ASSERT_EQ(second_day.add(sighting).kind, CorrectionKind::kApplied);
  EXPECT_LT(length_error_m(second_day), 0.2);
}

/// A vehicle that drives straight on, with a camera that looks aside.
struct Aside {
  explicit Aside(double looks_rad) : turned_rad(looks_rad) {}

  void drive(int frames) {
    for (const int end = frame + frames; frame < end; ++frame) {
      const std::int64_t stamp_ns = 40'000'000LL * frame;
      const Eigen::Isometry3d pose(Eigen::Translation3d(0.2 * frame, 0.0, 0.0));
      localizer.add(OdometryPose{stamp_ns, pose, 1e-7 * (frame + 1) * vision::Matrix6d::Identity()});
      was_disputed |= localizer.latest().state == State::kCompassOnly;
      if (frame < 5 || frame % 5 != 0) continue;
      localizer.add(AzimuthMeasurement{stamp_ns - 200'000'000, stamp_ns, 0.0, 1e-6, turned_rad, 1e-4, 0.1});
    }
  }

  static Parameters parameters() {
    Parameters parameters;
    parameters.clock_sigma_s = 0.0;
    return parameters;
  }

  double turned_rad;
  int frame = 0;
  bool was_disputed = false;
  Localizer localizer{parameters()};
};

TEST(LocalizerSelfCalibration, RemembersTheYawBetweenTheCamerasUnlessItIsAnother) {
  constexpr double kAside_rad = 0.2;
  Aside first_day(kAside_rad);
  first_day.drive(500);
  const auto measured = first_day.localizer.self_calibration();
  ASSERT_TRUE(measured.direction_rad);
  EXPECT_NEAR(measured.direction_rad->value, kAside_rad, 0.002);
  EXPECT_FALSE(measured.panorama_ahead_s) << "one clock";

  Aside same(kAside_rad), corrected(0.0);
  for (auto* day : {&same, &corrected}) day->localizer.set_self_calibration(measured);
  EXPECT_EQ(same.localizer.direction_offset().estimate_rad(), measured.direction_rad->value) << "before any panorama";
  EXPECT_NEAR(std::sqrt(same.localizer.direction_offset().variance_rad2()), vision::kDegree, 0.1 * vision::kDegree);
  for (auto* day : {&same, &corrected}) {
    day->drive(25);
    EXPECT_NEAR(day->localizer.direction_offset().estimate_rad(), day->turned_rad, 0.005);
    day->drive(475);
    EXPECT_FALSE(day->was_disputed) << day->turned_rad;
    ASSERT_TRUE(day->localizer.self_calibration().direction_rad);
    EXPECT_NEAR(day->localizer.self_calibration().direction_rad->value, day->turned_rad, 0.002);
  }
}

TEST(LocalizerSelfCalibration, IsNeverMoreCertainThanDaysLeaveItNorLessThanWithoutIt) {
  SelfCalibration measured;
  measured.panorama_ahead_s = Estimate{0.3, 1e-4};
  measured.direction_rad = Estimate{0.1, 1e-5};
  measured.turn_scale = Estimate{0.01, 5.0};
  measured.scale = Estimate{1.01, 0.0};
  Parameters parameters;
  const auto later = on_a_later_journey(measured, parameters);
  EXPECT_EQ(later.panorama_ahead_s->sigma, parameters.clock_sigma_s);
  EXPECT_NEAR(later.direction_rad->sigma, vision::kDegree, 1e-5);
  EXPECT_EQ(later.turn_scale->sigma, parameters.turn_scale_sigma);
  EXPECT_NEAR(later.scale->sigma, 0.0015, 1e-12);
  parameters.scale_sigma = parameters.clock_sigma_s = 0.0;
  const auto exact = on_a_later_journey(measured, parameters);
  EXPECT_FALSE(exact.scale || exact.panorama_ahead_s) << "the parameters say that nothing is wrong";
}

}  // namespace
}  // namespace panvo::localizer

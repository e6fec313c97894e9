// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/turn_error_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::localizer {
namespace {

TEST(TurnErrorFilter, LearnsNothingAtStandstill) {
  TurnErrorFilter filter(0.003, 1e-4);
  for (int i = 0; i < 100; ++i) filter.add(0.001, 0.01, 0.1, 1e-6);
  EXPECT_EQ(filter.error_rad(1.0, 100.0), 0.0);
  EXPECT_NEAR(filter.covariance()(0, 0), 9e-6, 1e-12);
  EXPECT_NEAR(filter.covariance()(1, 1), 1e-8, 1e-16);
}

constexpr double kLastingTurn_rad = 0.007;  // of a lean, until it is another one

TEST(TurnErrorFilter, TellsWhatExplainsTheDisagreementsAsSureAsItSays) {
  constexpr double kSigma_rad = 7e-4, kWay_m = 5.0, kLean = 1e-4;
  const double change_rad_m = kLean * std::sqrt(kWay_m * kLean / kLastingTurn_rad);  // in one way
  double nees = 0.0;
  constexpr int kJourneys = 200;
  for (int journey = 0; journey < kJourneys; ++journey) {
    std::mt19937_64 random(static_cast<unsigned>(journey));
    std::normal_distribution<double> normal;
    const double scale = 0.003 * normal(random);
    double lean_rad_m = kLean * normal(random);
    TurnErrorFilter filter(0.003, kLean);
    for (int i = 0; i < 30; ++i) {  // alternately left, right and straight
      const double turn = i % 3 == 0 ? -0.1 : i % 3 == 1 ? 0.1 : 0.0;
      lean_rad_m += change_rad_m * normal(random);
      const double unexplained_rad = scale * turn + lean_rad_m * kWay_m - filter.error_rad(turn, kWay_m);
      filter.add(-unexplained_rad + kSigma_rad * normal(random), turn, kWay_m, kSigma_rad * kSigma_rad);
    }
    const Eigen::Vector2d off(filter.scale() - scale, filter.lean_rad_m() - lean_rad_m);
    nees += off.dot(filter.covariance().ldlt().solve(off)) / 2.0 / kJourneys;
  }
  EXPECT_NEAR(nees, 1.0, 0.2);
}

TEST(TurnErrorFilter, IsNeverSurerThanTheCompassSees) {
  TurnErrorFilter filter(0.003, 1e-3);
  for (int i = 0; i < 10'000; ++i) filter.add(0.0, i % 2 == 0 ? 0.3 : -0.3, 5.0, 1e-6);
  EXPECT_NEAR(std::sqrt(filter.covariance()(0, 0)), 0.001, 1e-6);
}

TEST(TurnErrorFilter, FollowsALeanThatChanges) {
  TurnErrorFilter filter(0.003, 5e-4);
  const auto drive = [&](double lean_rad_m) {
    for (int i = 0; i < 60; ++i) {
      constexpr double kWay_m = 4.0;
      filter.add(filter.error_rad(0.0, kWay_m) - lean_rad_m * kWay_m, 0.0, kWay_m, 1e-6);
    }
    return filter.lean_rad_m();
  };
  EXPECT_NEAR(drive(5e-4), 5e-4, 0.5e-4);
  EXPECT_NEAR(drive(2e-4), 2e-4, 0.5e-4);  // after as long a way, although the mean of both is 3.5e-4
}

TEST(TurnErrorFilter, TellsByHowMuchAMeasurementChangedIt) {
  TurnErrorFilter filter(0.003, 5e-4);
  EXPECT_EQ(filter.add(0.001, 0.0, 0.1, 1e-6).lean_rad_m, 0.0) << "at standstill";
  double scale = 0.0, lean_rad_m = 0.0;
  for (int i = 0; i < 5; ++i) {
    const double memory_m = filter.errors().lean_memory_m;
    const auto change = filter.add(0.001, 0.1, 4.0, 1e-6);
    EXPECT_LT(change.lean_rad_m, 0.0) << "odometry turned too little to the left";
    EXPECT_NEAR(change.lean_memory_m, memory_m + 4.0, 1e-9) << "before the measurement, after its way";
    scale += change.scale;
    lean_rad_m += change.lean_rad_m;
  }
  EXPECT_DOUBLE_EQ(scale, filter.scale());
  EXPECT_DOUBLE_EQ(lean_rad_m, filter.lean_rad_m());
}

TEST(TurnErrorFilter, RemembersTheErrorOfTheLeanTheLessTheSurerItIs) {
  constexpr double kLean = 1e-4;
  TurnErrorFilter filter(0.003, kLean);
  EXPECT_NEAR(filter.errors().lean_memory_m, kLastingTurn_rad / kLean, 1e-6);
  for (int i = 0; i < 100; ++i) filter.add(0.0, 0.0, 4.0, 1e-6);
  // Steady state of the filter: sigma = sqrt(walk * noise), memory = noise / walk, each per sqrt(m).
  EXPECT_NEAR(filter.errors().lean_memory_m, std::sqrt(1e-6 / 4.0 * kLastingTurn_rad / std::pow(kLean, 3)), 3.0);
}

TEST(TurnErrorFilter, ExpectsTheLeanThatIsStatedBeforeTheFirstMeasurement) {
  TurnErrorFilter filter(0.003, 1e-4);
  filter.expect_lean(8e-4);
  EXPECT_NEAR(std::sqrt(filter.covariance()(1, 1)), 8e-4, 1e-9);
  filter.add(0.001, 0.0, 4.0, 1e-6);
  const double learned = std::sqrt(filter.covariance()(1, 1));
  EXPECT_LT(learned, 4e-4);
  filter.expect_lean(8e-4);
  EXPECT_EQ(std::sqrt(filter.covariance()(1, 1)), learned);
}

TEST(TurnErrorFilter, LearnsALeanThatBeginsOnTheWay) {
  constexpr double kWay_m = 4.0, kLean = 5e-4;
  const auto drive = [&](TurnErrorFilter& filter, double way_m, double lean_rad_m) {
    for (double at_m = 0.0; at_m < way_m; at_m += kWay_m) {
      filter.add(filter.error_rad(0.0, kWay_m) - lean_rad_m * kWay_m, 0.0, kWay_m, 1e-6);
    }
  };
  TurnErrorFilter filter(0.003, 4e-5);
  drive(filter, 400.0, 0.0);
  filter.expect_lean(1e-3);  // rain begins
  drive(filter, 60.0, kLean);
  EXPECT_NEAR(filter.lean_rad_m(), kLean, 0.1 * kLean);
}

/// Squared error of the heading over its variance, on a way without compass after one with it, of a lean that changes.
double nees_without_compass(unsigned seed, double lean_sigma_rad_m, int way_m) {
  constexpr double kSigma_rad = 7e-4;
  constexpr int kEach_m = 5;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double same = std::exp(-lean_sigma_rad_m / kLastingTurn_rad), other = std::sqrt(1.0 - same * same);  // in 1 m
  double lean_rad_m = lean_sigma_rad_m * normal(random);
  TurnErrorFilter filter(0.0, lean_sigma_rad_m);
  double off_rad = 0.0, variance_rad2 = 0.0;
  const auto drive = [&](int metres) {
    off_rad = variance_rad2 = 0.0;
    for (int i = 0; i < metres; ++i) {
      lean_rad_m = same * lean_rad_m + other * lean_sigma_rad_m * normal(random);
      off_rad += filter.lean_rad_m() - lean_rad_m;
      variance_rad2 += filter.advance(1.0);
    }
  };
  for (int i = 0; i < 40; ++i) {
    drive(kEach_m);
    filter.measure_turn();
    filter.add(off_rad + kSigma_rad * normal(random), 0.0, kEach_m, kSigma_rad * kSigma_rad);
  }
  drive(way_m);
  const auto errors = filter.errors();
  const double ways = way_m / errors.lean_memory_m, persisting = 2.0 * (ways + std::expm1(-ways)) / (ways * ways);
  variance_rad2 += errors.covariance(1, 1) * way_m * way_m * persisting;  // as covariance_of_turns() says
  return off_rad * off_rad / variance_rad2;
}

TEST(TurnErrorFilter, IsAsUnsureOfALeanAsItMayHaveChangedSinceTheCompassFellSilent) {
  constexpr unsigned kJourneys = 400;
  for (const double lean_sigma_rad_m : {1.4e-4, 7e-4}) {
    for (const int way_m : {20, 80, 300}) {
      double nees = 0.0;
      for (unsigned seed = 0; seed < kJourneys; ++seed) {
        nees += nees_without_compass(seed, lean_sigma_rad_m, way_m) / kJourneys;
      }
      EXPECT_NEAR(nees, 1.1, 0.4) << lean_sigma_rad_m << " rad/m, " << way_m << " m";
    }
  }
}

TEST(TurnErrorFilter, AddsNothingToALeanThatNoCompassEverMeasured) {
  TurnErrorFilter filter(0.003, 1e-4);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(filter.advance(1.0), 0.0) << i;
}

TEST(TurnErrorFilter, LearnsAnewAfterALongWayWithoutCompass) {
  TurnErrorFilter filter(0.003, 1e-4);
  for (int i = 0; i < 100; ++i) filter.add(0.0, 0.0, 4.0, 1e-6);
  const double known_m = filter.errors().lean_memory_m;
  for (int i = 0; i < 1000; ++i) filter.advance(1.0);
  EXPECT_NEAR(filter.add(0.0, 0.0, 4.0, 1e-6).lean_memory_m, kLastingTurn_rad / 1e-4 + 4.0, 0.1)
      << "as before the first";
  EXPECT_LT(known_m, 0.8 * kLastingTurn_rad / 1e-4);
}

TEST(TurnErrorFilter, ALeanThatMayHaveChangedHasNothingToDoWithTheScale) {
  TurnErrorFilter filter(0.003, 1e-4);
  for (int i = 0; i < 100; ++i) filter.add(0.0, 0.02, 4.0, 1e-8);  // tells the sum of both only
  const auto correlation = [&] {
    const auto covariance = filter.covariance();
    return covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1));
  };
  EXPECT_LT(correlation(), -0.5);
  for (int i = 0; i < 1000; ++i) filter.advance(1.0);
  filter.add(0.0, 0.02, 4.0, 1.0);  // tells nothing
  EXPECT_NEAR(correlation(), 0.0, 0.05);
}

TEST(TurnErrorFilter, IsNotMovedByAMeasurementThatIsWrong) {
  TurnErrorFilter filter(0.003, 1e-4);
  filter.add(0.2, 0.3, 5.0, 1e-6);
  EXPECT_EQ(filter.error_rad(1.0, 100.0), 0.0);
}

TEST(TurnErrorFilter, OfAnExactCalibrationIsNone) {
  TurnErrorFilter filter(0.0, 0.0);
  for (int i = 0; i < 10; ++i) filter.add(0.001, 0.5, 5.0, 1e-6);
  EXPECT_EQ(filter.error_rad(1.0, 100.0), 0.0);
}

}  // namespace
}  // namespace panvo::localizer

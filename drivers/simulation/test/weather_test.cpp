// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/weather.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panvo::simulation {
namespace {

const Day kTen{.hour = 10.0};

Effects sudden_light() {
  Effects effects;
  effects.sudden_light = true;
  return effects;
}

TEST(Weather, IsSteadyWithoutEffects) {
  const Weather weather(kTen, 600.0, {}, 1);
  EXPECT_TRUE(weather.clouds().empty());
  EXPECT_EQ(weather.cloud_cover(0.0), weather.cloud_cover(500.0));
  EXPECT_EQ(weather.hour(600.0), 10.0);
}

TEST(Weather, TheSunGoesOnByTwoHoursOverTheJourney) {
  Effects effects;
  effects.sun_drift = true;
  const Weather weather(kTen, 600.0, effects, 1);
  EXPECT_DOUBLE_EQ(weather.hour(600.0), 12.0);
}

TEST(Weather, ACloudTakesTheSunWithinHalfASecondAndGivesItBack) {
  const Weather weather(kTen, 600.0, sudden_light(), 3);
  ASSERT_GE(weather.clouds().size(), 10u);
  for (const auto& cloud : weather.clouds()) {
    const double before = weather.cloud_cover(cloud.from_s);
    EXPECT_LT(before, 0.1);
    EXPECT_NEAR(weather.cloud_cover(cloud.from_s + 0.5), cloud.cover, 1e-12);
    EXPECT_NEAR(weather.cloud_cover(cloud.to_s), cloud.cover, 1e-12);
    EXPECT_NEAR(weather.cloud_cover(cloud.to_s + 0.5), before, 1e-12);
  }
}

TEST(Weather, OfAnOvercastDayHasNoSun) {
  const Weather weather({.overcast = true}, 600.0, sudden_light(), 3);
  EXPECT_TRUE(weather.clouds().empty());
  EXPECT_EQ(weather.light(100.0).sun.norm(), 0.0f);
  EXPECT_TRUE(weather.light(100.0).overcast);
}

TEST(Weather, OfAWetDayIsOvercastAlsoAtNight) {
  const Weather weather({.wet = true}, 600.0, sudden_light(), 3);
  EXPECT_TRUE(weather.clouds().empty());
  EXPECT_TRUE(weather.light(100.0).overcast);
  EXPECT_TRUE(Weather({.night = true, .wet = true}, 600.0, sudden_light(), 3).light(100.0).overcast);
  EXPECT_FALSE(Weather({.night = true}, 600.0, sudden_light(), 3).light(100.0).overcast);
}

TEST(Day, IsWetOrInSnow) {
  EXPECT_NO_THROW(check_day({.season = simulated_world::Season::kBare, .wet = true}));
  EXPECT_NO_THROW(check_day({.season = simulated_world::Season::kSnow}));
  EXPECT_THROW(check_day({.season = simulated_world::Season::kSnow, .wet = true}), std::invalid_argument);
}

TEST(Weather, AtNightLampsReplaceTheSun) {
  const Weather weather({.night = true}, 600.0, sudden_light(), 3);
  EXPECT_TRUE(weather.clouds().empty());
  EXPECT_TRUE(weather.light(100.0).lamps);
  EXPECT_EQ(weather.light(100.0).sun.norm(), 0.0f);
  EXPECT_EQ(weather.light(100.0).evening, weather.light(200.0).evening);
  EXPECT_NE(weather.light(100.0).evening, Weather({.night = true}, 600.0, sudden_light(), 4).light(100.0).evening);
  EXPECT_FALSE(Weather(kTen, 600.0, sudden_light(), 3).light(100.0).lamps);
}

}  // namespace
}  // namespace panvo::simulation

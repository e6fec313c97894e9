// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/clock_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panvo::localizer {
namespace {

TEST(ClockOffset, LearnsOnlyWhileTheTurnChanges) {
  ClockOffset clock(0.05);
  for (int i = 0; i < 100; ++i) clock.add(0.001, 0.0, 1e-6);
  EXPECT_EQ(clock.estimate_s(), 0.0);
  EXPECT_NEAR(clock.variance_s2(), 0.05 * 0.05, 1e-6);
}

TEST(ClockOffset, IsWhatExplainsTheDisagreement) {
  ClockOffset clock(0.05);
  constexpr double kTrue_s = 0.03;
  for (int i = 0; i < 200; ++i) {
    const double rate_change = 0.4 * std::sin(0.7 * i);
    clock.add(-(kTrue_s - clock.estimate_s()) * rate_change, rate_change, 1e-6);
  }
  EXPECT_NEAR(clock.estimate_s(), kTrue_s, 1e-4);
  EXPECT_EQ(clock.estimate_ns(), std::llround(clock.estimate_s() * 1e9));
}

TEST(ClockOffset, IsNotMovedByAMeasurementThatIsWrong) {
  ClockOffset clock(0.05);
  clock.add(1.0, 0.3, 1e-6);
  EXPECT_EQ(clock.estimate_s(), 0.0);
}

TEST(ClockOffset, OfClocksThatAreOneIsNone) {
  ClockOffset clock(0.0);
  for (int i = 0; i < 10; ++i) clock.add(0.001, 0.5, 1e-6);
  EXPECT_NEAR(clock.estimate_s(), 0.0, 1e-4);
}

}  // namespace
}  // namespace panvo::localizer

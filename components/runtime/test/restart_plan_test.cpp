// SPDX-License-Identifier: Apache-2.0
#include "restart_plan.hpp"

#include <gtest/gtest.h>

namespace panvo::runtime {
namespace {

constexpr std::int64_t kOneSecond_ns = 1'000'000'000;

TEST(RestartPlan, WaitsLongerEachTimeAndGivesUpAfterThree) {
  RestartPlan plan;
  EXPECT_EQ(plan.failed(0), kOneSecond_ns / 10);
  EXPECT_EQ(plan.failed(kOneSecond_ns), 2 * kOneSecond_ns);
  EXPECT_EQ(plan.failed(3 * kOneSecond_ns), 13 * kOneSecond_ns);
  EXPECT_EQ(plan.failed(14 * kOneSecond_ns), std::nullopt);
}

TEST(RestartPlan, ForgetsFailuresOfMoreThanAMinuteAgo) {
  RestartPlan plan;
  for (const std::int64_t second : {0, 1, 2}) ASSERT_TRUE(plan.failed(second * kOneSecond_ns));
  EXPECT_EQ(plan.failed(63 * kOneSecond_ns), 63 * kOneSecond_ns + kOneSecond_ns / 10);
}

}  // namespace
}  // namespace panvo::runtime

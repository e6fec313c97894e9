// SPDX-License-Identifier: Apache-2.0
#include "dds/rate_limit.hpp"

#include <gtest/gtest.h>

namespace panvo::runtime::dds {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

int taken(RateLimit& limit, std::int64_t from_ns, std::int64_t period_ns, int messages) {
  int count = 0;
  for (int i = 0; i < messages; ++i) count += limit.take(from_ns + i * period_ns) ? 1 : 0;
  return count;
}

TEST(RateLimit, TakesAllThatComesWithinTheRate) {
  RateLimit limit(100.0, 10.0);
  EXPECT_EQ(taken(limit, kSecond_ns, kSecond_ns / 100, 100'000), 100'000);
}

TEST(RateLimit, TakesTheRateOfAFlood) {
  RateLimit limit(100.0, 10.0);
  const int of_ten_seconds = taken(limit, kSecond_ns, kSecond_ns / 10'000, 100'000);
  EXPECT_GE(of_ten_seconds, 1090);  // one second's burst, then the rate
  EXPECT_LE(of_ten_seconds, 1101);
}

TEST(RateLimit, TakesALateJoinersHistoryAtOnce) {
  RateLimit limit(100.0, 10'000.0);
  EXPECT_EQ(taken(limit, kSecond_ns, 0, 20'000), 10'000);
}

TEST(RateLimit, WithoutABurstAllowsOneSecondsMessagesAtOnceAndThenTheRate) {
  RateLimit limit(3.0, 1.0);
  EXPECT_EQ(taken(limit, 5 * kSecond_ns, 0, 10), 3);
  EXPECT_FALSE(limit.take(5 * kSecond_ns + kSecond_ns / 4));
  EXPECT_TRUE(limit.take(5 * kSecond_ns + kSecond_ns / 2));
}

TEST(RateLimit, OfZeroAllowsNothing) {
  RateLimit limit(0.0, 1.0);
  EXPECT_FALSE(limit.take(kSecond_ns));
}

}  // namespace
}  // namespace panvo::runtime::dds

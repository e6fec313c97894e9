// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/host_stamps.hpp"

#include <gtest/gtest.h>

namespace panvo::v4l2_camera {
namespace {

constexpr std::int64_t kMs = 1'000'000, kSecond = 1'000 * kMs;
constexpr std::int64_t kSystem_ns = 1'700'000'000 * kSecond;

/// The host booted 100 s before the system clock showed kSystem_ns.
HostTime at(std::int64_t monotonic_ns) { return {monotonic_ns, kSystem_ns + monotonic_ns - 100 * kSecond}; }

TEST(HostStamps, AreTheKernelsInSystemTime) {
  HostStamps stamps;
  EXPECT_EQ(stamps.stamp_ns(100 * kSecond, at(100 * kSecond + 30 * kMs)), kSystem_ns);
  EXPECT_EQ(stamps.stamp_ns(100 * kSecond + 33 * kMs, at(100 * kSecond + 34 * kMs)), kSystem_ns + 33 * kMs);
  EXPECT_EQ(stamps.disbelieved(), 0u);
}

TEST(HostStamps, FollowASystemClockThatIsSetAndIncreaseAllTheSame) {
  HostStamps stamps;
  const auto first_ns = stamps.stamp_ns(100 * kSecond, at(100 * kSecond + kMs));
  auto later = at(100 * kSecond + 34 * kMs);
  later.system_ns += 5 * kSecond;  // set forward
  EXPECT_EQ(stamps.stamp_ns(100 * kSecond + 33 * kMs, later), kSystem_ns + 33 * kMs + 5 * kSecond);
  const auto back_ns = stamps.stamp_ns(100 * kSecond + 66 * kMs, at(100 * kSecond + 67 * kMs));  // and back
  EXPECT_EQ(back_ns, kSystem_ns + 33 * kMs + 5 * kSecond + 1);
  EXPECT_GT(back_ns, first_ns);
}

TEST(HostStamps, AreTheArrivalsWhereTheDriverHasNone) {
  HostStamps stamps;
  EXPECT_EQ(stamps.stamp_ns(std::nullopt, at(100 * kSecond)), kSystem_ns);
  EXPECT_EQ(stamps.disbelieved(), 0u);
}

TEST(HostStamps, MayLieALittleInTheFutureButNotFarAndNotLongAgo) {
  HostStamps stamps;
  EXPECT_EQ(stamps.stamp_ns(100 * kSecond + 70 * kMs, at(100 * kSecond)), kSystem_ns + 70 * kMs);
  EXPECT_EQ(stamps.stamp_ns(110 * kSecond, at(101 * kSecond)), kSystem_ns + kSecond) << "the arrival";
  EXPECT_EQ(stamps.stamp_ns(90 * kSecond, at(102 * kSecond)), kSystem_ns + 2 * kSecond);
  EXPECT_EQ(stamps.stamp_ns(0, at(103 * kSecond)), kSystem_ns + 3 * kSecond);
  EXPECT_EQ(stamps.disbelieved(), 3u);
}

}  // namespace
}  // namespace panvo::v4l2_camera

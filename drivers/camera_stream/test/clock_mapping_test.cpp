// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/clock_mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace panvo::camera_stream {
namespace {

constexpr std::int64_t kMs = 1'000'000, kSecond = 1000 * kMs;

/// A camera whose clock is `offset_ns` ahead of the host's and runs faster by `drift`. Transfer to the host takes at
/// least `min_delay_ns`, usually little more, sometimes much more.
struct Camera {
  std::int64_t offset_ns = 10 * kSecond;
  double drift = 100e-6;
  std::int64_t min_delay_ns = 0;
  std::int64_t began_ns = 1'700'000'000 * kSecond;  // host time of the first frame
  std::mt19937 random{7};

  std::int64_t device_ns(std::int64_t host_ns) const {
    return host_ns + offset_ns + std::llround(drift * static_cast<double>(host_ns - began_ns));
  }
  std::int64_t arrival_ns(std::int64_t host_ns) {
    const double usual_ns = std::exponential_distribution<double>(1.0 / (0.5 * kMs))(random);
    const bool is_held_up = std::uniform_real_distribution<double>(0, 1)(random) < 0.05;
    return host_ns + min_delay_ns + static_cast<std::int64_t>(usual_ns) + (is_held_up ? 40 * kMs : 0);
  }
};

/// Largest error of the mapping over the frames from `from_s` to `to_s`, at 60 Hz, ns.
double max_error_ns(
    ClockMapping& mapping, Camera& camera, double from_s, double to_s,
    const std::function<void(int)>& before_frame = [](int) {}) {
  double largest = 0.0;
  for (int i = 0; i < static_cast<int>(to_s * 60.0); ++i) {
    before_frame(i);
    const std::int64_t taken_ns = camera.began_ns + i * kSecond / 60;
    const std::int64_t mapped_ns = mapping.to_host_ns(camera.device_ns(taken_ns), camera.arrival_ns(taken_ns));
    if (i >= static_cast<int>(from_s * 60.0))
      largest = std::max(largest, std::abs(static_cast<double>(mapped_ns - taken_ns)));
  }
  return largest;
}

TEST(ClockMapping, FollowsAnOffsetAndADriftToWellUnderAMillisecond) {
  for (const double drift : {100e-6, -100e-6, 0.0}) {
    Camera camera{.drift = drift};
    ClockMapping mapping;
    EXPECT_LT(max_error_ns(mapping, camera, 10.0, 120.0), 0.5 * kMs) << drift;
    EXPECT_NEAR(mapping.drift(), -drift, 20e-6);
    EXPECT_EQ(mapping.resets(), 0u);
  }
}

TEST(ClockMapping, IsNotMuchWorseInItsFirstSeconds) {
  Camera camera;
  ClockMapping mapping;
  EXPECT_LT(max_error_ns(mapping, camera, 1.0, 10.0), 2.0 * kMs);
}

TEST(ClockMapping, LeavesTheLeastDelayInTheStamp) {
  Camera camera{.min_delay_ns = 5 * kMs};
  ClockMapping mapping;
  EXPECT_NEAR(max_error_ns(mapping, camera, 10.0, 30.0), 5.0 * kMs, 0.5 * kMs);
}

TEST(ClockMapping, IsNotMovedByAHostThatSleptForTwoSeconds) {
  Camera camera;
  ClockMapping mapping;
  max_error_ns(mapping, camera, 0.0, 20.0);
  // Three seconds of frames; those of the first two seconds are delivered at once.
  const std::int64_t slept_from_ns = camera.began_ns + 20 * kSecond;
  for (int i = 0; i < 180; ++i) {
    const std::int64_t taken_ns = slept_from_ns + i * kSecond / 60;
    const std::int64_t arrival_ns = std::max(camera.arrival_ns(taken_ns), slept_from_ns + 2 * kSecond);
    const std::int64_t mapped_ns = mapping.to_host_ns(camera.device_ns(taken_ns), arrival_ns);
    ASSERT_LT(std::abs(static_cast<double>(mapped_ns - taken_ns)), 0.5 * kMs) << "frame " << i;
  }
  EXPECT_EQ(mapping.resets(), 0u);
}

TEST(ClockMapping, BeginsAnewWithAClockThatBeganAnew) {
  Camera camera;
  ClockMapping mapping;
  const double error_ns = max_error_ns(mapping, camera, 21.0, 30.0, [&](int i) {
    if (i == 20 * 60) camera.offset_ns = -camera.began_ns;  // power cycle: the clock shows 20 s
    if (i == 25 * 60) camera.offset_ns = 3'000 * kSecond;   // set forward
  });
  EXPECT_EQ(mapping.resets(), 2u);
  EXPECT_LT(error_ns, 45.0 * kMs);  // a frame may be delayed just after a reset
}

TEST(ClockMapping, GivesStampsThatIncrease) {
  Camera camera;
  ClockMapping mapping;
  std::int64_t last_ns = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool is_set_anew = i == 1000;
    if (is_set_anew) camera.offset_ns -= 7 * kSecond;
    const std::int64_t taken_ns = camera.began_ns + i * kSecond / 60;
    // After a reset, the offset comes from the first frame alone. If that is delayed, its stamp is later than the next.
    const std::int64_t held_up_ns = i == 0 || is_set_anew ? 90 * kMs : 0;
    const std::int64_t mapped_ns =
        mapping.to_host_ns(camera.device_ns(taken_ns), camera.arrival_ns(taken_ns) + held_up_ns);
    ASSERT_GT(mapped_ns, last_ns) << "frame " << i;
    last_ns = mapped_ns;
  }
  EXPECT_EQ(mapping.resets(), 1u);
}

TEST(ClockMapping, TakesStampsALittleAheadAsTheyAre) {
  Camera camera{.offset_ns = 0, .drift = 0.0, .min_delay_ns = -70 * kMs};  // stamped 70 ms ahead of the arrival
  ClockMapping mapping;
  max_error_ns(mapping, camera, 0.0, 10.0);
  EXPECT_EQ(mapping.resets(), 0u);
}

TEST(ClockMapping, NeedsTheSameMemoryHoweverLongItRuns) {
  // Almost 17 hours with a slowly changing drift, as caused by temperature.
  ClockMapping mapping;
  std::int64_t device_ns = 0;
  for (int i = 0; i < 60'000; ++i) {
    const std::int64_t host_ns = i * kSecond;
    device_ns += kSecond + std::llround(50e-6 * std::sin(i / 10'000.0) * static_cast<double>(kSecond));
    const std::int64_t mapped_ns = mapping.to_host_ns(device_ns, host_ns + (i % 3 == 0 ? 0 : kMs / 2));
    if (i > 20) {
      ASSERT_LT(std::abs(static_cast<double>(mapped_ns - host_ns)), 1.0 * kMs) << "second " << i;
    }
  }
}

}  // namespace
}  // namespace panvo::camera_stream

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>

#include "panvo/runtime/testing.hpp"

namespace {

// Duration for which the computer was suspended, as this program sees it.
std::atomic<std::int64_t> suspended_s = 0;

}  // namespace

/// The C library's function, in the whole test program. CLOCK_BOOTTIME goes on while the computer is suspended.
extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const auto status = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  if (status == 0 && clock == CLOCK_BOOTTIME) time->tv_sec += suspended_s;
  return status;
}

namespace panvo::runtime {
namespace {

TEST(PassingTime, CountsASuspensionOfTheComputer) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  Container container({.replay = false});
  Context* context = nullptr;
  ComponentDescription idle;
  idle.name = "idle";
  idle.name_space = "/";
  container.add(idle, [&](Context& made) {
    context = &made;
    return std::make_unique<Component>();
  });
  const std::int64_t before_ns = context->passing_ns();
  suspended_s = 3600;
  const std::int64_t after_ns = context->passing_ns();
  suspended_s = 0;
  EXPECT_GE(after_ns - before_ns, kHour_ns);
  EXPECT_LT(after_ns - before_ns, 2 * kHour_ns);
}

}  // namespace
}  // namespace panvo::runtime

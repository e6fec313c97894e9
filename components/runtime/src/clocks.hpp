// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <ctime>

/// The only place where the runtime reads a system clock.
namespace panvo::runtime::clocks {

inline std::int64_t read_ns(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

inline std::int64_t monotonic_ns() noexcept { return read_ns(CLOCK_MONOTONIC); }
/// Goes on while the computer is suspended: the vehicle may have been moved meanwhile.
inline std::int64_t elapsed_ns() noexcept { return read_ns(CLOCK_BOOTTIME); }
inline std::int64_t system_ns() noexcept { return read_ns(CLOCK_REALTIME); }
inline std::int64_t process_cpu_ns() noexcept { return read_ns(CLOCK_PROCESS_CPUTIME_ID); }

}  // namespace panvo::runtime::clocks

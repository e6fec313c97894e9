// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace panvo::vision {

inline constexpr double kSecond_ns = 1e9;

inline double seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(to_ns - from_ns) / kSecond_ns;
}

inline std::int64_t to_ns(double time_s) { return std::llround(time_s * kSecond_ns); }

}  // namespace panvo::vision

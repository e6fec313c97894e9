// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::localizer {

/// Detects that a clock was set back: several consecutive messages before the last one have increasing stamps.
class SetBack {
 public:
  /// Adds a message `back_ns` before the latest; returns true if the clock was set back.
  bool add(std::int64_t stamp_ns, std::int64_t back_ns) {
    const bool agrees = run_ > 0 && stamp_ns > stamp_ns_;
    run_ = back_ns < kMinStep_ns ? 0 : agrees ? run_ + 1 : 1;
    stamp_ns_ = stamp_ns;
    if (run_ < kRun) return false;
    run_ = 0;
    return true;
  }

 private:
  static constexpr std::int64_t kMinStep_ns = 500'000'000;  // smaller steps are reordering
  static constexpr int kRun = 5;

  int run_ = 0;
  std::int64_t stamp_ns_ = 0;
};

}  // namespace panvo::localizer

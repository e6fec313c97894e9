// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

namespace panvo::localizer {

/// Tells a clock that was set forward from a silence, by the times at which messages arrive. None arrives before its
/// stamp, so that the fastest ones show the offset of the clock. A late one shows nothing: messages wait while a process
/// is stopped.
class ClockJump {
 public:
  /// By how much the clock was set forward before this message, ns; 0: it was not. `arrival_ns`: monotonic, or the
  /// stamps themselves if nothing else tells the time.
  std::int64_t add(std::int64_t stamp_ns, std::int64_t arrival_ns) {
    const std::int64_t offset_ns = stamp_ns - arrival_ns;
    const std::int64_t ahead_ns = offset_ns - fastest_ns_.value_or(offset_ns);
    const std::int64_t since_ns = std::clamp<std::int64_t>(arrival_ns - arrival_ns_, 0, kMaxSince_ns);
    fastest_ns_ = std::max(offset_ns, fastest_ns_.value_or(offset_ns) - since_ns / kForget);
    arrival_ns_ = arrival_ns;
    return ahead_ns > kLeast_ns ? ahead_ns : 0;
  }

  /// By how much a clock that was set back before this message was set, ns.
  std::int64_t behind_ns(std::int64_t stamp_ns, std::int64_t arrival_ns) const {
    return fastest_ns_ ? *fastest_ns_ - (stamp_ns - arrival_ns) : 0;
  }

 private:
  /// Longer than the first message is delayed while a process starts. A shorter step counts as a gap, which is harmless.
  static constexpr std::int64_t kLeast_ns = 2'000'000'000;
  static constexpr std::int64_t kForget = 1000;                // clocks drift by less than this fraction of the time
  static constexpr std::int64_t kMaxSince_ns = 1'000'000'000;  // so that a long gap does not discard the offset

  std::optional<std::int64_t> fastest_ns_;  // stamp minus arrival, of the fastest messages
  std::int64_t arrival_ns_ = 0;             // of the last message
};

}  // namespace panvo::localizer

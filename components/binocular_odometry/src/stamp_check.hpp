// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace panvo::binocular_odometry {

/// Checks that the stamps of frames increase.
class StampCheck {
 public:
  std::optional<std::string> find_fault(std::int64_t stamp_ns) const {
    if (!last_ns_ || stamp_ns > *last_ns_) return std::nullopt;
    return "stamp " + std::to_string(stamp_ns) + " ns is not later than the previous stamp, " +
           std::to_string(*last_ns_) + " ns";
  }

  /// Call for every frame, including those with faults. A stamp that is a little early is that of a late frame; an
  /// earlier one shows that the clock was set back or a recording restarts, of which only the first frame is lost.
  void remember(std::int64_t stamp_ns) {
    const bool is_of_late_frame = last_ns_ && stamp_ns <= *last_ns_ && *last_ns_ - stamp_ns < kSetBack_ns;
    if (!is_of_late_frame) last_ns_ = stamp_ns;
  }

 private:
  static constexpr std::int64_t kSetBack_ns = 500'000'000;  // smaller steps are reordering

  std::optional<std::int64_t> last_ns_;
};

}  // namespace panvo::binocular_odometry

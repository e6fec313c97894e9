// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "clock_jump.hpp"
#include "panvo/vision/stamp_sequence.hpp"

namespace panvo::localizer {

/// The clock of the odometry's stamps, which may be set during a run.
class OdometryClock {
 public:
  /// The stamp of the next message; `latest_ns`: of the last one that the localizer has taken, if any. Returns false for
  /// a message that is not later than the ones before.
  bool add(std::int64_t stamp_ns, std::int64_t arrival_ns, const std::optional<std::int64_t>& latest_ns) {
    const auto order = stamps_.add(stamp_ns);
    set_back_ns_ = 0;
    less_back_ns_ = 0;
    if (order == vision::StampOrder::kNotLater) return false;
    const std::int64_t behind_ns = jump_.behind_ns(stamp_ns, arrival_ns);
    const std::int64_t forward_ns = jump_.add(stamp_ns, arrival_ns);
    if (!latest_ns) return true;
    if (order == vision::StampOrder::kSetBack && stamp_ns <= *latest_ns) {
      set_back_ns_ = std::max(behind_ns, *latest_ns - stamp_ns + kInterval_ns);
    } else {
      set_back_ns_ = -forward_ns;
    }
    if (set_back_ns_ == 0) {
      learn_more(stamp_ns - arrival_ns);
      return true;
    }
    since_set_ = 1;
    fastest_since_ns_ = stamp_ns - arrival_ns;
    is_far_ = std::abs(set_back_ns_) > kFar_ns;
    jump_ = {};
    jump_.add(stamp_ns, arrival_ns);
    return true;
  }

  /// By how much it was set back before the last message, or forward if negative, ns; 0: it was not.
  std::int64_t set_back_ns() const noexcept { return set_back_ns_; }
  /// By how much less it was set back than said before, or more forward, as the last message shows, ns. The first ones of
  /// a new time come late: they wait until others confirm it.
  std::int64_t less_back_ns() const noexcept { return less_back_ns_; }

  /// After the clock was set by more than panoramas are ever late, their stamps show whether their clock was set, too.
  enum class PanoramasClock {
    kAny,      ///< the odometry's was not set, or by less
    kAlike,    ///< it was set alike, as by a host that stamps both
    kAnother,  ///< it was not
  };
  PanoramasClock panoramas_clock(std::int64_t panorama_ns, std::int64_t latest_ns) {
    if (!is_far_) return PanoramasClock::kAny;
    is_far_ = std::abs(panorama_ns - latest_ns) > kFar_ns;
    return is_far_ ? PanoramasClock::kAnother : PanoramasClock::kAlike;
  }

 private:
  static constexpr std::int64_t kInterval_ns = 40'000'000;  // between two messages, if their arrival does not tell it
  static constexpr std::int64_t kFar_ns = 5'000'000'000;
  static constexpr int kWaited = 5;  // as many messages of a new time arrive at once, at most, the last one in time

  void learn_more(std::int64_t offset_ns) {
    if (since_set_ == 0) return;
    since_set_ = since_set_ < kWaited - 1 ? since_set_ + 1 : 0;
    less_back_ns_ = std::max<std::int64_t>(offset_ns - fastest_since_ns_, 0);
    fastest_since_ns_ += less_back_ns_;
  }

  vision::StampSequence stamps_{2};  // few, as each pose that is refused is motion unseen
  ClockJump jump_;
  std::int64_t set_back_ns_ = 0, less_back_ns_ = 0;
  int since_set_ = 0;                  // messages, while they may have waited
  std::int64_t fastest_since_ns_ = 0;  // stamp minus arrival
  bool is_far_ = false;
};

}  // namespace panvo::localizer

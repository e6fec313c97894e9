// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::vision {

enum class StampOrder {
  kLater,     ///< than all before
  kNotLater,  ///< reordered, or of a clock that may have been set back
  kSetBack,   ///< not later either, but the clock was set back: this is the latest from now on
};

/// Stamps of one topic in order of arrival. The clock was set back if several consecutive stamps are well before the
/// latest one and increase.
class StampSequence {
 public:
  StampSequence() = default;
  /// `run`: so many stamps tell a clock that was set back. Those before the last one are lost.
  explicit StampSequence(int run) : needed_(run) {}

  StampOrder add(std::int64_t stamp_ns) {
    if (!latest_ns_ || stamp_ns > *latest_ns_) {
      run_ = 0;
      latest_ns_ = stamp_ns;
      return StampOrder::kLater;
    }
    const bool agrees = run_ > 0 && stamp_ns > before_ns_;
    run_ = *latest_ns_ - stamp_ns < kMinStep_ns ? 0 : agrees ? run_ + 1 : 1;
    before_ns_ = stamp_ns;
    if (run_ < needed_) return StampOrder::kNotLater;
    run_ = 0;
    latest_ns_ = stamp_ns;
    return StampOrder::kSetBack;
  }

  /// Of the time that counts; nullopt before the first stamp.
  std::optional<std::int64_t> latest_ns() const noexcept { return latest_ns_; }

 private:
  static constexpr std::int64_t kMinStep_ns = 500'000'000;  // smaller steps are reordering

  int needed_ = 5;
  int run_ = 0;  // stamps so far that show a clock that was set back
  std::int64_t before_ns_ = 0;
  std::optional<std::int64_t> latest_ns_;
};

}  // namespace panvo::vision

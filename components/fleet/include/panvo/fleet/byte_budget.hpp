// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace panvo::fleet {

/// Limits what is sent: a mean rate, and bursts of a few seconds of it. Times are of any monotonic clock.
class ByteBudget {
 public:
  ByteBudget(double bytes_per_s, double burst_bytes) : rate_(bytes_per_s), burst_(burst_bytes), left_(burst_bytes) {}

  void advance(std::int64_t now_ns) {
    if (has_begun_ && now_ns > now_ns_) {
      left_ = std::min(burst_, left_ + rate_ * 1e-9 * static_cast<double>(now_ns - now_ns_));
    }
    now_ns_ = has_begun_ ? std::max(now_ns_, now_ns) : now_ns;
    has_begun_ = true;
  }
  /// Whether anything may be sent. One message may exceed what is left; the next one waits for it.
  bool is_open() const noexcept { return left_ > 0.0; }
  void take(std::size_t bytes) { left_ -= static_cast<double>(bytes); }

 private:
  double rate_, burst_, left_;
  std::int64_t now_ns_ = 0;
  bool has_begun_ = false;
};

/// Counts bytes, in all and over the last ten seconds.
class ByteCount {
 public:
  void add(std::int64_t now_ns, std::size_t bytes) {
    advance(now_ns);
    total_ += bytes;
    seconds_[index()] += bytes;
  }
  /// Mean over the last ten seconds that are complete.
  double per_s(std::int64_t now_ns) {
    advance(now_ns);
    std::uint64_t sum = 0;
    for (const auto bytes : seconds_) sum += bytes;
    return static_cast<double>(sum - seconds_[index()]) / (kSeconds - 1);
  }
  std::uint64_t total() const noexcept { return total_; }

 private:
  static constexpr int kSeconds = 11;

  std::size_t index() const { return static_cast<std::size_t>(second_ % kSeconds); }
  void advance(std::int64_t now_ns) {
    const std::int64_t second = std::max<std::int64_t>(0, now_ns / 1'000'000'000);
    if (second - second_ >= kSeconds) {
      seconds_.fill(0);
      second_ = second;
    }
    for (; second_ < second; ++second_) seconds_[static_cast<std::size_t>((second_ + 1) % kSeconds)] = 0;
  }

  std::uint64_t total_ = 0;
  std::int64_t second_ = 0;
  std::array<std::uint64_t, kSeconds> seconds_{};
};

}  // namespace panvo::fleet

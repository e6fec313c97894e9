// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace panvo::runtime::dds {

/// Token bucket: `rate_hz` messages per second, with bursts of up to one second's messages or `burst`, whichever is
/// larger. A rate of 0 allows none.
class RateLimit {
 public:
  RateLimit(double rate_hz, double burst) : rate_hz_(rate_hz), full_(std::max(rate_hz, burst)), left_(full_) {}

  /// Whether another message is allowed at that monotonic time.
  bool take(std::int64_t now_ns) {
    left_ = std::min(full_, left_ + 1e-9 * static_cast<double>(now_ns - last_ns_) * rate_hz_);
    last_ns_ = now_ns;
    if (rate_hz_ <= 0.0 || left_ < 1.0) return false;
    left_ -= 1.0;
    return true;
  }

 private:
  double rate_hz_, full_, left_;
  std::int64_t last_ns_ = 0;
};

}  // namespace panvo::runtime::dds

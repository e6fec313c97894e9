// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace panvo::runtime::dds {

/// Limits of a service.
struct RequestLimits {
  double per_s = 0;
  std::uint32_t size = 0;  ///< bytes
};

/// Token bucket: `per_s` requests per second, with bursts of up to one second's requests.
class RequestRate {
 public:
  explicit RequestRate(double per_s) : per_s_(per_s), left_(std::max(per_s, 1.0)) {}

  bool lets_pass(std::int64_t now_ns) {
    constexpr double kSecond_ns = 1e9;
    const double since_s = last_ns_ < 0 ? 0 : static_cast<double>(now_ns - last_ns_) / kSecond_ns;
    left_ = std::min(left_ + since_s * per_s_, std::max(per_s_, 1.0));
    last_ns_ = now_ns;
    if (per_s_ <= 0 || left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double per_s_, left_;
  std::int64_t last_ns_ = -1;
};

}  // namespace panvo::runtime::dds

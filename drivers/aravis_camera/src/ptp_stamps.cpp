// SPDX-License-Identifier: Apache-2.0
#include "panvo/aravis_camera/ptp_stamps.hpp"

#include <fmt/format.h>

#include <cmath>

namespace panvo::aravis_camera {

std::int64_t PtpStamps::to_host_ns(std::int64_t device_ns, std::int64_t arrival_ns) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::int64_t kMaxWay = 300'000'000,
                         kAhead = 50'000'000;   // exposure to arrival; offset of synchronised clocks
  constexpr std::int64_t kMaxLeapSeconds = 60;  // TAI has been 37 s ahead of UTC since 2017
  if (!seconds_ahead_) {
    seconds_ahead_ = std::llround(static_cast<double>(device_ns - arrival_ns) / static_cast<double>(kSecond));
    const std::int64_t way_ns = arrival_ns - (device_ns - *seconds_ahead_ * kSecond);
    problem_.clear();
    if (std::abs(*seconds_ahead_) > kMaxLeapSeconds || way_ns > kMaxWay || way_ns < -kAhead) {
      problem_ = fmt::format(
          "the camera's PTP clock and this host's clock differ by {:.3f} s: synchronise both to one master "
          "(ptp4l, phc2sys), or use clock mapped",
          static_cast<double>(device_ns - arrival_ns) * 1e-9);
    }
  }
  return device_ns - *seconds_ahead_ * kSecond;
}

}  // namespace panvo::aravis_camera

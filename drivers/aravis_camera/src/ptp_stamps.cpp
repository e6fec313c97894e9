// SPDX-License-Identifier: Apache-2.0
#include "panvo/aravis_camera/ptp_stamps.hpp"

#include <fmt/format.h>

#include <cmath>

namespace panvo::aravis_camera {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMaxWay = 300'000'000,
                       kAhead = 50'000'000;       // exposure to arrival; offset of synchronised clocks
constexpr std::int64_t kMaxDelay = 10 * kSecond;  // of a frame on a busy host: not the clock
constexpr std::int64_t kMaxLeapSeconds = 60;      // TAI has been 37 s ahead of UTC since 2017

}  // namespace

std::int64_t PtpStamps::to_host_ns(std::int64_t device_ns, std::int64_t arrival_ns) {
  const auto way_ns = [&] { return arrival_ns - (device_ns - *seconds_ahead_ * kSecond); };
  if (seconds_ahead_ && way_ns() >= -kAhead && way_ns() <= kMaxDelay) return device_ns - *seconds_ahead_ * kSecond;
  // The first frame, or the camera's clock was set: a camera counts from its start until it has found its master.
  seconds_ahead_ = std::llround(static_cast<double>(device_ns - arrival_ns) / static_cast<double>(kSecond));
  problem_.clear();
  if (std::abs(*seconds_ahead_) <= kMaxLeapSeconds && way_ns() <= kMaxWay && way_ns() >= -kAhead)
    return device_ns - *seconds_ahead_ * kSecond;
  seconds_ahead_.reset();
  problem_ = fmt::format(
      "the camera's PTP clock and this host's clock differ by {:.3f} s: synchronise both to one master "
      "(ptp4l, phc2sys), or use clock mapped; frames have the time of their arrival meanwhile",
      static_cast<double>(device_ns - arrival_ns) * 1e-9);
  return arrival_ns;
}

}  // namespace panvo::aravis_camera

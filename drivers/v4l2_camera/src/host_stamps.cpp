// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/host_stamps.hpp"

#include <algorithm>

namespace panvo::v4l2_camera {
namespace {

constexpr std::int64_t kOldest_ns = 2'000'000'000;  // allows for frames queued on a busy host
constexpr std::int64_t kAhead_ns = 100'000'000;

}  // namespace

std::int64_t HostStamps::stamp_ns(std::optional<std::int64_t> frame_ns, const HostTime& arrival) {
  std::int64_t age_ns = 0;
  if (frame_ns) {
    const std::int64_t told_ns = arrival.monotonic_ns - *frame_ns;
    const bool is_believed = told_ns >= -kAhead_ns && told_ns <= kOldest_ns;
    age_ns = is_believed ? told_ns : 0;
    if (!is_believed) ++disbelieved_;
  }
  last_ns_ = std::max(arrival.system_ns - age_ns, last_ns_ + 1);  // pairing and tracking rely on the order
  return last_ns_;
}

}  // namespace panvo::v4l2_camera

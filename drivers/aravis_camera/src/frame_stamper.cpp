// SPDX-License-Identifier: Apache-2.0
#include "frame_stamper.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace panvo::aravis_camera {

std::int64_t FrameStamper::stamp_ns(const ReceivedFrame& frame, std::int64_t now_ns) {
  const std::int64_t arrival_ns = frame.arrival_ns() > 0 ? std::min(frame.arrival_ns(), now_ns) : now_ns;
  const std::int64_t device_ns = frame.device_ns();
  std::int64_t stamp_ns = arrival_ns;
  if (device_ns != 0 && source_ == StampSource::kMapped) stamp_ns = mapping_.to_host_ns(device_ns, arrival_ns);
  if (device_ns != 0 && source_ == StampSource::kPtp) stamp_ns = ptp_.to_host_ns(device_ns, arrival_ns);
  last_ns_ = std::max(stamp_ns, last_ns_ + 1);  // pairing and tracking rely on the order
  return last_ns_;
}

void FrameStamper::restart() {
  mapping_.restart();
  ptp_.restart();
}

std::string FrameStamper::description() const {
  if (source_ != StampSource::kMapped) return {};
  return fmt::format("{:+.1f} ppm relative to the host clock", -mapping_.drift() * 1e6);
}

}  // namespace panvo::aravis_camera

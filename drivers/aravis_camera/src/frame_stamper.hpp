// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "opened_camera.hpp"
#include "panvo/aravis_camera/camera_grabber.hpp"
#include "panvo/aravis_camera/ptp_stamps.hpp"
#include "panvo/camera_stream/clock_mapping.hpp"

namespace panvo::aravis_camera {

/// Host time of a camera's frames, from where it is set to come from.
class FrameStamper {
 public:
  explicit FrameStamper(StampSource source) : source_(source) {}

  /// The stamp, ns since the host's epoch; what was received is no older than `now_ns`.
  std::int64_t stamp_ns(const ReceivedFrame& frame, std::int64_t now_ns);

  /// The camera was opened anew: its clock may be another one.
  void restart();

  std::uint64_t clock_resets() const noexcept { return mapping_.resets(); }
  /// What there is to tell of the clock: "12.3 ppm slower than the host's"; empty: nothing.
  std::string description() const;
  const std::string& problem() const noexcept { return ptp_.problem(); }

 private:
  StampSource source_;
  camera_stream::ClockMapping mapping_;
  PtpStamps ptp_;
  std::int64_t last_ns_ = 0;
};

}  // namespace panvo::aravis_camera

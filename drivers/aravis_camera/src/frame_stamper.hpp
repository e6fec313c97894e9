// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "opened_camera.hpp"
#include "panvo/aravis_camera/camera_grabber.hpp"
#include "panvo/aravis_camera/ptp_stamps.hpp"
#include "panvo/camera_stream/clock_mapping.hpp"

namespace panvo::aravis_camera {

/// Host stamps of a camera's frames, from the configured source.
class FrameStamper {
 public:
  explicit FrameStamper(StampSource source) : source_(source) {}

  /// Returns the stamp in ns of the host's system clock. Stamps strictly increase. `now_ns`: current time, an upper
  /// limit of the frame's arrival.
  std::int64_t stamp_ns(const ReceivedFrame& frame, std::int64_t now_ns);

  /// Call after the camera was reopened: its clock may have changed.
  void restart();

  std::uint64_t clock_resets() const noexcept { return mapping_.resets(); }
  /// Clock drift for diagnostics: "+12.3 ppm relative to the host clock"; empty unless stamps are mapped.
  std::string description() const;
  const std::string& problem() const noexcept { return ptp_.problem(); }

 private:
  StampSource source_;
  camera_stream::ClockMapping mapping_;
  PtpStamps ptp_;
  std::int64_t last_ns_ = 0;
};

}  // namespace panvo::aravis_camera

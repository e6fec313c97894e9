// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::v4l2_camera {

/// Both host clocks at the same time, ns: CLOCK_MONOTONIC, used by the kernel for frames, and the system clock, used
/// for all stamps here.
struct HostTime {
  std::int64_t monotonic_ns = 0, system_ns = 0;
};

/// Converts frame stamps to the host's system time. Both clocks are read with each frame, so that corrections of the
/// system clock are followed. Stamps strictly increase even then.
class HostStamps {
 public:
  /// Returns the stamp, ns. `frame_ns`: CLOCK_MONOTONIC, nullopt: none from the driver; `arrival`: the current time. A
  /// stamp more than 2 s before or 0.1 s after the arrival is rejected and counted, and the arrival is used instead:
  /// drivers that compute stamps from the camera's clock may be wrong. Slightly early stamps are normal for such
  /// drivers.
  std::int64_t stamp_ns(std::optional<std::int64_t> frame_ns, const HostTime& arrival);

  /// Number of rejected stamps.
  std::uint64_t disbelieved() const noexcept { return disbelieved_; }

 private:
  std::int64_t last_ns_ = 0;
  std::uint64_t disbelieved_ = 0;
};

}  // namespace panvo::v4l2_camera

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace panvo::v4l2_camera {

/// Both of the host's clocks at one moment, ns: CLOCK_MONOTONIC, by which the kernel stamps frames, and that of all stamps here.
struct HostTime {
  std::int64_t monotonic_ns = 0, system_ns = 0;
};

/// Frames' stamps in the host's system time. Both clocks are read with each frame, so that a system clock that is being set right is followed; stamps
/// increase all the same.
class HostStamps {
 public:
  /// `frame_ns`: by CLOCK_MONOTONIC, nullopt: the driver has none; `arrival`: now. A stamp further from the arrival than any frame takes is not
  /// believed (drivers that compute stamps from the camera's clock may get lost); the arrival is taken then, and counted. Slightly in the future is
  /// in order: drivers with a clock of their own stamp ahead.
  std::int64_t stamp_ns(std::optional<std::int64_t> frame_ns, const HostTime& arrival);

  /// Stamps that were not believed.
  std::uint64_t disbelieved() const noexcept { return disbelieved_; }

 private:
  std::int64_t last_ns_ = 0;
  std::uint64_t disbelieved_ = 0;
};

}  // namespace panvo::v4l2_camera

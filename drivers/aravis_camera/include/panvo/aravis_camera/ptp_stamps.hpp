// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace panvo::aravis_camera {

/// Host stamps of a camera that is synchronised by PTP (IEEE 1588) to the same master as the host. They differ from the
/// host's clock only by whole seconds, the offset of TAI (PTP's time scale) from UTC.
class PtpStamps {
 public:
  std::int64_t to_host_ns(std::int64_t device_ns, std::int64_t arrival_ns);

  /// Why the stamps are unreliable; empty if they are not. If the host is not synchronised to the same clock, the
  /// offset between them is not a whole number of seconds.
  const std::string& problem() const noexcept { return problem_; }
  void restart() { seconds_ahead_.reset(); }

 private:
  std::optional<std::int64_t> seconds_ahead_;
  std::string problem_;
};

}  // namespace panvo::aravis_camera

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace panvo::aravis_camera {

/// Stamps of a camera that follows the network's clock (IEEE 1588), which the host follows, too: they are the host's already, but for the whole
/// seconds by which TAI, PTP's own time, differs from UTC.
class PtpStamps {
 public:
  std::int64_t to_host_ns(std::int64_t device_ns, std::int64_t arrival_ns);

  /// Why the stamps are not to be trusted, empty: they may be. A host that does not follow the same clock shows by the rest of a second between them.
  const std::string& problem() const noexcept { return problem_; }
  void restart() { seconds_ahead_.reset(); }

 private:
  std::optional<std::int64_t> seconds_ahead_;
  std::string problem_;
};

}  // namespace panvo::aravis_camera

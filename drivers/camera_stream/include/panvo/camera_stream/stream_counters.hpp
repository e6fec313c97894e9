// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "diagnostic_msgs/msg/DiagnosticStatus.h"

namespace panvo::camera_stream {

/// Frame statistics of one camera since the start.
struct StreamCounters {
  std::uint64_t frames = 0;      ///< complete
  std::uint64_t dropped = 0;     ///< not received: gaps in the frame numbers
  std::uint64_t damaged = 0;     ///< received, but unusable
  std::uint64_t incomplete = 0;  ///< received in part
  std::uint64_t resent = 0;      ///< packets received after a resend request
  std::uint64_t unpaired = 0;    ///< complete, without partners
  std::uint64_t reconnects = 0;
  std::uint64_t failed_opens = 0;
  std::uint64_t refused_settings = 0;  ///< by the camera, when settings were last applied
  std::uint64_t clock_resets = 0;
  std::optional<std::int64_t> newest_stamp_ns;
};

/// Diagnostic report of one camera.
struct StreamReport {
  std::string name;    ///< "left"
  std::string serial;  ///< empty: not known yet
  bool is_streaming = false;
  std::string state;   ///< "streaming", or why not
  std::string remedy;  ///< against incomplete frames
  StreamCounters counters;
  std::map<std::string, std::string> details;  ///< further entries: format, packet size, chunk data
};

/// The report as a diagnostic status: error while not streaming; warning if frames were lost since `before`, the
/// counters of `interval_s` ago, or if settings were refused.
diagnostic_msgs::msg::DiagnosticStatus to_status(const std::string& component, const StreamReport& report,
                                                 const StreamCounters& before, std::int64_t now_ns, double interval_s);

}  // namespace panvo::camera_stream

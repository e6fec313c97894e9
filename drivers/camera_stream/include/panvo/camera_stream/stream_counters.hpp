// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "diagnostic_msgs/msg/DiagnosticStatus.h"

namespace panvo::camera_stream {

/// What became of the frames of one camera since the start.
struct StreamCounters {
  std::uint64_t frames = 0;      ///< came whole
  std::uint64_t dropped = 0;     ///< never came: gaps in the frame numbers
  std::uint64_t damaged = 0;     ///< came, and could not be used
  std::uint64_t incomplete = 0;  ///< came in part
  std::uint64_t resent = 0;      ///< packets that came on a second request
  std::uint64_t unpaired = 0;    ///< whole, without partners
  std::uint64_t reconnects = 0;
  std::uint64_t failed_opens = 0;
  std::uint64_t refused_settings = 0;  ///< by the camera, the last time that it was opened
  std::uint64_t clock_resets = 0;
  std::optional<std::int64_t> newest_stamp_ns;
};

/// One camera for diagnostics.
struct StreamReport {
  std::string name;    ///< "left"
  std::string serial;  ///< empty: not known yet
  bool is_streaming = false;
  std::string state;   ///< "streaming", or why not
  std::string remedy;  ///< against incomplete frames
  StreamCounters counters;
  std::map<std::string, std::string> details;  ///< what else to show: format, packet size, chunk data
};

/// The report as a diagnostic status: an error while nothing comes, a warning when something was lost since `before`, which was `interval_s` ago.
diagnostic_msgs::msg::DiagnosticStatus to_status(const std::string& component, const StreamReport& report,
                                                 const StreamCounters& before, std::int64_t now_ns, double interval_s);

}  // namespace panvo::camera_stream

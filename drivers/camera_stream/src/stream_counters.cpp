// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/stream_counters.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace panvo::camera_stream {
namespace {

constexpr std::uint8_t kOk = 0, kWarning = 1, kError = 2;  // values of diagnostic_msgs/msg/DiagnosticStatus

void add(diagnostic_msgs::msg::DiagnosticStatus& status, const std::string& key, const std::string& value) {
  diagnostic_msgs::msg::KeyValue entry;
  entry.key(key);
  entry.value(value);
  status.values().push_back(std::move(entry));
}

/// Frames lost between two readings, as text ("2 dropped, 1 damaged"); empty: none.
std::string losses(const StreamCounters& now, const StreamCounters& before) {
  const std::array<std::pair<const char*, std::uint64_t>, 4> kinds{{{"dropped", now.dropped - before.dropped},
                                                                    {"damaged", now.damaged - before.damaged},
                                                                    {"incomplete", now.incomplete - before.incomplete},
                                                                    {"unpaired", now.unpaired - before.unpaired}}};
  std::string text;
  for (const auto& [kind, count] : kinds) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  }
  return text;
}

void add_counters(diagnostic_msgs::msg::DiagnosticStatus& status, const StreamCounters& counters) {
  const auto count = [&](const char* key, std::uint64_t value) { add(status, key, std::to_string(value)); };
  count("frames", counters.frames);
  count("dropped", counters.dropped);
  count("damaged", counters.damaged);
  count("incomplete", counters.incomplete);
  count("resent packets", counters.resent);
  count("unpaired", counters.unpaired);
  count("reconnects", counters.reconnects);
  count("failed tries to open", counters.failed_opens);
  count("refused settings", counters.refused_settings);
  count("resets of the camera's clock", counters.clock_resets);
}

}  // namespace

diagnostic_msgs::msg::DiagnosticStatus to_status(const std::string& component, const StreamReport& report,
                                                 const StreamCounters& before, std::int64_t now_ns, double interval_s) {
  const auto& counters = report.counters;
  diagnostic_msgs::msg::DiagnosticStatus status;
  status.name("panvo: " + component + ": " + report.name);
  status.hardware_id(report.serial.empty() ? "none" : report.serial);
  add(status, "state", report.state);
  add(status, "rate", fmt::format("{:.1f} Hz", static_cast<double>(counters.frames - before.frames) / interval_s));
  add_counters(status, counters);
  add(status, "age of the newest frame",
      counters.newest_stamp_ns ? fmt::format("{:.3f} s", static_cast<double>(now_ns - *counters.newest_stamp_ns) * 1e-9)
                               : "no frame yet");
  for (const auto& [key, value] : report.details) add(status, key, value);

  const std::string lost = losses(counters, before);
  if (!report.is_streaming) {
    status.level(kError);
    status.message(report.state);
  } else if (!lost.empty() || counters.refused_settings > 0) {
    status.level(kWarning);
    std::string message = lost.empty() ? fmt::format("{} settings refused, see the log", counters.refused_settings)
                                       : fmt::format("in the last {:.0f} s: {}", interval_s, lost);
    if (counters.incomplete > before.incomplete && !report.remedy.empty()) message += "; " + report.remedy;
    status.message(message);
  } else {
    status.level(kOk);
    status.message(report.state);
  }
  return status;
}

}  // namespace panvo::camera_stream

// SPDX-License-Identifier: Apache-2.0
#include "process_use.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <utility>

namespace panvo::runtime {
namespace {

/// MB; 0 if /proc is not mounted.
double resident_memory() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;  // pages
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

}  // namespace

diagnostic_msgs::msg::DiagnosticStatus ProcessUse::status(const std::string& container, std::int64_t cpu_ns,
                                                          double interval_s) {
  const double used_s = static_cast<double>(cpu_ns - std::exchange(told_cpu_ns_, cpu_ns)) * 1e-9;
  diagnostic_msgs::msg::DiagnosticStatus status;
  status.name("panvo: process of " + container);
  status.hardware_id("none");
  status.message("runs");
  const auto add = [&status](const char* key, const std::string& value) {
    diagnostic_msgs::msg::KeyValue entry;
    entry.key(key);
    entry.value(value);
    status.values().push_back(entry);
  };
  add("CPU", fmt::format("{:.1f} %", 100 * used_s / interval_s));
  add("memory", fmt::format("{:.0f} MB", resident_memory()));
  return status;
}

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "diagnostic_msgs/msg/DiagnosticStatus.h"

namespace panvo::runtime {

/// What this process takes of the machine, as one status of /diagnostics: CPU, % of one core, and resident memory, MB.
class ProcessUse {
 public:
  /// Call once per published status. `cpu_ns`: CPU time of the process since it began; `container` is its name.
  diagnostic_msgs::msg::DiagnosticStatus status(const std::string& container, std::int64_t cpu_ns, double interval_s);

 private:
  std::int64_t told_cpu_ns_ = 0;
};

}  // namespace panvo::runtime

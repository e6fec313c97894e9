// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "diagnostic_msgs/msg/DiagnosticStatus.h"
#include "panvo/runtime/service.hpp"

namespace panvo::runtime {

/// Counts the requests to a container and its components, as one status of /diagnostics.
class ServiceTotals {
 public:
  void add(const std::vector<std::unique_ptr<BridgeService>>& services);

  /// Call once per published status. Warning while requests are refused or dropped. `container` is its name.
  diagnostic_msgs::msg::DiagnosticStatus status(const std::string& container, double interval_s);

 private:
  ServiceCounters now_, told_;
};

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "context_state.hpp"
#include "diagnostic_msgs/msg/DiagnosticArray.h"

namespace panvo::runtime {

/// How the components of a container are, as ROS 2's diagnostic tools show it: for each one a status with the rate, latency, waiting and dropped
/// messages of each input and the times of each stage. Warns while messages are being dropped; an error is a component that has stopped.
class Diagnostics {
 public:
  /// `interval_s`: since the last call, for rates.
  diagnostic_msgs::msg::DiagnosticArray collect(const std::vector<const Context::State*>& components,
                                                std::int64_t stamp_ns, double interval_s);

 private:
  struct Previous {
    std::uint64_t handled = 0, dropped = 0;
  };
  std::map<std::string, Previous> previous_;  // by component and input
};

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "context_state.hpp"
#include "diagnostic_msgs/msg/DiagnosticArray.h"

namespace panvo::runtime {

/// How the components of a container are, as ROS 2's diagnostic tools show it: for each one a status with the rate, latency, waiting and dropped
/// messages of each input, what it could not use and why, and the times of each stage. Warns while messages are being dropped or rejected; an error
/// is a component that has stopped.
class Diagnostics {
 public:
  /// `interval_s`: since the last call, for rates.
  diagnostic_msgs::msg::DiagnosticArray collect(const std::vector<const Context::State*>& components,
                                                std::int64_t stamp_ns, double interval_s);

  /// Of a component that has failed and is not there any more.
  static diagnostic_msgs::msg::DiagnosticStatus of_unmade(const std::string& name);

 private:
  struct Previous {
    std::uint64_t received = 0, handled = 0, dropped = 0, rejected = 0, overwritten = 0, refused = 0;
  };
  struct Rejected {
    std::uint64_t messages = 0;
    std::string why;
  };

  /// How many were dropped since the last call.
  std::uint64_t tell_inputs(const Context::State& component, double interval_s,
                            diagnostic_msgs::msg::DiagnosticStatus& status);
  /// How many were overwritten since the last call, in the memory that their writer shares, while they were read here.
  std::uint64_t tell_overwritten(const Context::State& component, diagnostic_msgs::msg::DiagnosticStatus& status);
  /// How many were refused since the last call because of their size or number.
  Rejected tell_refused(const Context::State& component, diagnostic_msgs::msg::DiagnosticStatus& status);
  /// What was rejected since the last call, with the reason of one of them: by the component, and before it came to it.
  Rejected tell_rejections(const Context::State& component, diagnostic_msgs::msg::DiagnosticStatus& status);
  void tell_rejections(const std::string& component, const std::string& topic, const Rejections::Count& count,
                       diagnostic_msgs::msg::DiagnosticStatus& status, Rejected& newly);

  std::map<std::string, Previous> previous_;  // by component and topic
};

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "context_state.hpp"
#include "diagnostic_msgs/msg/DiagnosticArray.h"

namespace panvo::runtime {

/// Creates ROS 2 diagnostics of a container's components: one status per component with rate, latency, waiting and
/// dropped messages of each input, rejected messages with reasons, CPU and stage times. Warning while messages are dropped
/// or rejected; error if the component has stopped.
class Diagnostics {
 public:
  /// `interval_s`: time since the last call, for rates.
  diagnostic_msgs::msg::DiagnosticArray collect(const std::vector<const Context::State*>& components,
                                                std::int64_t stamp_ns, double interval_s);

  /// Status of a failed component that could not be restarted.
  static diagnostic_msgs::msg::DiagnosticStatus of_unmade(const std::string& name);

 private:
  struct Previous {
    std::uint64_t received = 0, handled = 0, dropped = 0, rejected = 0, overwritten = 0, refused = 0;
    double cpu_ms = 0;
  };
  struct Rejected {
    std::uint64_t messages = 0;
    std::string why;
  };

  /// Number of messages dropped since the last call.
  std::uint64_t tell_inputs(const Context::State& component, double interval_s,
                            diagnostic_msgs::msg::DiagnosticStatus& status);
  /// CPU time that the component's messages took since the last call, % of one core.
  void tell_cpu(const Context::State& component, double interval_s, diagnostic_msgs::msg::DiagnosticStatus& status);
  /// Number of messages overwritten in shared memory while being read, since the last call.
  std::uint64_t tell_overwritten(const Context::State& component, diagnostic_msgs::msg::DiagnosticStatus& status);
  /// Messages refused for their size or rate since the last call.
  Rejected tell_refused(const Context::State& component, diagnostic_msgs::msg::DiagnosticStatus& status);
  /// Messages rejected since the last call, by the component or before delivery, with one of the reasons.
  Rejected tell_rejections(const Context::State& component, diagnostic_msgs::msg::DiagnosticStatus& status);
  void tell_rejections(const std::string& component, const std::string& topic, const RejectedMessages::Count& count,
                       diagnostic_msgs::msg::DiagnosticStatus& status, Rejected& newly);

  std::map<std::string, Previous> previous_;  // by component and topic
};

}  // namespace panvo::runtime

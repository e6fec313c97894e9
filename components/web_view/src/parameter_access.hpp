// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/runtime/topic_access.hpp"
#include "parameter.hpp"
#include "rcl_interfaces/msg/ParameterEvent.h"

namespace panvo::web_view {

/// Parameters of all nodes by their services. A parameter is named "/NODE/NAME", NODE with its namespace. Waits for the
/// nodes, for one at most 2 s, for all at most 5 s. Thread-safe.
class ParameterAccess {
 public:
  /// What became of a request, and the reasons for what did not.
  struct Result {
    std::vector<Parameter> parameters;
    std::vector<std::string> problems;
  };

  explicit ParameterAccess(runtime::TopicAccess& topics) : topics_(topics) {}

  /// Values of these parameters; of all, if `names` is empty. Without those that do not exist.
  Result get(const std::vector<std::string>& names) const;

  /// Sets parameters; those of one node in one request. Returns their values afterwards.
  Result set(const std::vector<Parameter>& parameters) const;

 private:
  runtime::TopicAccess& topics_;
};

/// The new values that an event tells of; removed ones are without value.
std::vector<Parameter> parameters_of(const rcl_interfaces::msg::ParameterEvent& event);

}  // namespace panvo::web_view

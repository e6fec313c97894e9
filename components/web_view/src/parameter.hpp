// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace panvo::web_view {

/// Value of a parameter in Foxglove's protocol, which has no other types. monostate: not set.
using ParameterValue = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<bool>,
                                    std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;

struct Parameter {
  std::string name;  ///< "/NODE/NAME"
  ParameterValue value;
};

}  // namespace panvo::web_view

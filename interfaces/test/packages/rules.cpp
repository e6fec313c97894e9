// SPDX-License-Identifier: Apache-2.0
#include "rules.hpp"

namespace test_msgs::msg {

std::optional<std::string> problem_of(const Lamp& lamp) {
  return std::string_view(lamp.name().c_str()).empty() ? std::optional<std::string>("name is empty") : std::nullopt;
}

}  // namespace test_msgs::msg

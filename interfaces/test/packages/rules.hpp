// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "test_msgs/msg/Lamp.h"

namespace test_msgs::msg {

/// A lamp must have a name.
std::optional<std::string> problem_of(const Lamp& lamp);

}  // namespace test_msgs::msg

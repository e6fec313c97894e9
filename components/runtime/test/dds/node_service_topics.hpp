// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/interfaces/topics.hpp"
#include "std_msgs/msg/String.h"

namespace panvo::runtime::test {

/// QoS of the topics of the controlled component: nothing may be lost.
inline constexpr interfaces::Qos kAll{.depth = 1000, .keep_all = true};
inline constexpr interfaces::Topic<std_msgs::msg::String> kToEcho{"/robot/to_echo", kAll};
inline constexpr interfaces::Topic<std_msgs::msg::String> kEchoed{"/robot/echoed", kAll};

}  // namespace panvo::runtime::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "panvo/interfaces/topic.hpp"
#include "rcl_interfaces/msg/Log.h"
#include "rosgraph_msgs/msg/Clock.h"

/// Topics that the runtime itself publishes and reads, as every ROS 2 node does.
namespace panvo::topics {

inline constexpr interfaces::Topic<diagnostic_msgs::msg::DiagnosticArray> kDiagnostics{"/diagnostics",
                                                                                       interfaces::qos::kDefault};
/// Played or simulated time, for ROS 2 nodes with use_sim_time.
inline constexpr interfaces::Topic<rosgraph_msgs::msg::Clock> kClock{"/clock", interfaces::qos::kSensorData};
inline constexpr interfaces::Topic<rcl_interfaces::msg::Log> kRosout{"/rosout", interfaces::qos::kLog};

}  // namespace panvo::topics

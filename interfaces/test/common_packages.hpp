// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::interfaces {

/// One message of each package in ROS 2's common_interfaces that has its own library.
inline constexpr const char* kOneOfEachPackage[] = {
    "std_msgs/msg/ColorRGBA",         "std_srvs/srv/SetBool_Request",
    "actionlib_msgs/msg/GoalID",      "diagnostic_msgs/srv/SelfTest_Request",
    "geometry_msgs/msg/Polygon",      "shape_msgs/msg/Mesh",
    "sensor_msgs/msg/LaserScan",      "nav_msgs/msg/OccupancyGrid",
    "stereo_msgs/msg/DisparityImage", "trajectory_msgs/msg/JointTrajectory",
    "visualization_msgs/msg/Marker"};

/// Loads these libraries from the build tree.
inline void load_common_packages() {
  setenv("PANVO_PLUGIN_PATH", PANVO_TEST_LIBRARIES, 1);
  for (const char* name : kOneOfEachPackage) find_message_type(name);
}

}  // namespace panvo::interfaces

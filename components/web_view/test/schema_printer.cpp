// SPDX-License-Identifier: Apache-2.0
// Prints every message type with both of its definitions, as JSON, for the page's tests of what viewers make of them.
#include <iostream>
#include <nlohmann/json.hpp>

#include "omg_idl.hpp"
#include "panvo/interfaces/message_type.hpp"

int main() {
  // One of each package whose library is loaded only when a message of it is asked for.
  for (const char* name :
       {"actionlib_msgs/msg/GoalID", "diagnostic_msgs/msg/KeyValue", "geographic_msgs/msg/GeoPoint",
        "geometry_msgs/msg/Wrench", "nav_msgs/msg/GridCells", "robot_localization/srv/SetPose_Request",
        "sensor_msgs/msg/LaserScan", "shape_msgs/msg/Mesh", "std_msgs/msg/Float64MultiArray",
        "std_srvs/srv/SetBool_Request", "stereo_msgs/msg/DisparityImage", "trajectory_msgs/msg/JointTrajectory",
        "visualization_msgs/msg/Marker"})
    panvo::interfaces::find_message_type(name);
  auto types = nlohmann::json::array();
  for (const auto* type : panvo::interfaces::message_types())
    types.push_back({{"name", type->name},
                     {"ros2msg", type->definition},
                     {"idlName", panvo::web_view::idl_name(type->name)},
                     {"omgidl", panvo::web_view::idl_definition(type->name, type->definition)}});
  std::cout << types.dump() << '\n';
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace panvo::runtime::dds {

/// A topic with its wire names and its displayed name.
struct WireTopic {
  std::string name, type_name;
  std::string shown;  // displayed name
};

/// Conversion between ROS 2 names and wire names.

/// "/stereo/left/image_rect" -> "rt/stereo/left/image_rect"
std::string wire_topic_name(std::string_view name);

/// "rt/odom" -> "/odom"; nullopt for other topics (services, discovery, plain DDS).
std::optional<std::string> topic_name_from_wire(std::string_view wire_name);

/// "sensor_msgs/msg/Image" -> "sensor_msgs::msg::dds_::Image_"; nullopt for a name of another form.
std::optional<std::string> wire_type_name(std::string_view name);

/// "sensor_msgs::msg::dds_::Image_" -> "sensor_msgs/msg/Image"; nullopt for a name of another form.
std::optional<std::string> type_name_from_wire(std::string_view wire_name);

/// "/node/get_parameters" -> "rq/node/get_parametersRequest"
std::string wire_request_name(std::string_view service);
/// "/node/get_parameters" -> "rr/node/get_parametersReply"
std::string wire_reply_name(std::string_view service);

/// The service whose requests or replies use that topic; nullopt if none.
std::optional<std::string> service_from_wire_request(std::string_view wire_name);
std::optional<std::string> service_from_wire_reply(std::string_view wire_name);

/// "rcl_interfaces/srv/GetParameters_Request" -> "rcl_interfaces/srv/GetParameters", likewise "_Response"; others are
/// unchanged.
std::string service_type_name(std::string_view type_name);

}  // namespace panvo::runtime::dds

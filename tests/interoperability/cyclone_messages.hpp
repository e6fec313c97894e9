// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <string>
#include <string_view>

namespace panvo::test::cyclone {

/// A message type of Cyclone DDS, and the known values (known_answers.hpp) in the structs that Cyclone's idlc generated
/// from interfaces/idl.
struct MessageKind {
  std::string_view name;              ///< "nav_msgs/msg/Odometry"
  dds_topic_descriptor_t descriptor;  ///< with the type name of ROS 2 on the wire
  void* (*make)(int n);               ///< result must be freed by dds_sample_free with `descriptor`
  std::string (*wrong)(const void*,
                       int n);  ///< first field that differs from message `n`, and its value; empty: none
};

/// nullptr for an unknown type.
const MessageKind* find_message_kind(std::string_view name);

}  // namespace panvo::test::cyclone

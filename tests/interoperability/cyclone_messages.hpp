// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <string>
#include <string_view>

namespace panvo::test::cyclone {

/// A message type as Cyclone DDS knows it, and the known answers (known_answers.hpp) in the structs that Cyclone's idlc made of interfaces/idl.
struct MessageKind {
  std::string_view name;              ///< "nav_msgs/msg/Odometry"
  dds_topic_descriptor_t descriptor;  ///< named as ROS 2 names the type on the wire
  void* (*make)(int n);               ///< to be freed by dds_sample_free with `descriptor`
  std::string (*wrong)(const void*,
                       int n);  ///< the first field that is not as in message `n`, and its value; empty: all are
};

/// nullptr for a type that is not here.
const MessageKind* find_message_kind(std::string_view name);

}  // namespace panvo::test::cyclone

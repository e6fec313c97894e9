// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/interfaces/qos.hpp"

namespace panvo::runtime {

/// A node of this process as others are to see it. Names are resolved.
struct NodeDescription {
  std::string name_space;  ///< "/" or "/robot"
  std::string name;
  std::vector<std::string> publishes, subscribes;  ///< topics
  std::vector<std::string> serves;                 ///< services
};

/// What ROS 2 uses an endpoint for.
enum class EndpointKind : std::uint8_t { kTopic, kRequest, kReply, kOther };

/// A reader or writer of another process.
struct GraphEndpoint {
  EndpointKind kind = EndpointKind::kOther;
  std::string name;       ///< of the topic or service; as on the wire for kOther
  std::string type_name;  ///< "nav_msgs/msg/Odometry", "rcl_interfaces/srv/GetParameters"; as on the wire for kOther
  bool is_writer = false;
  interfaces::Qos qos;    ///< reliability and durability only
  std::string type_hash;  ///< "RIHS01_...", empty: not told
  std::string gid;        ///< hexadecimal
};

/// A node of another process.
struct GraphNode {
  std::string name_space, name;
  std::vector<std::string> readers, writers;  ///< their gids
};

/// What is known of other processes now.
struct Graph {
  std::vector<GraphNode> nodes;
  std::vector<GraphEndpoint> endpoints;
};

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/interfaces/qos.hpp"

namespace panvo::runtime {

/// A node of this process as seen by others. Names are resolved.
struct NodeDescription {
  std::string name_space;  ///< "/" or "/robot"
  std::string name;
  std::vector<std::string> publishes, subscribes;  ///< topics
  std::vector<std::string> serves;                 ///< services
};

/// Purpose of an endpoint in ROS 2.
enum class EndpointKind : std::uint8_t { kTopic, kRequest, kReply, kOther };

/// A reader or writer of another process.
struct GraphEndpoint {
  EndpointKind kind = EndpointKind::kOther;
  std::string name;       ///< of the topic or service; wire name for kOther
  std::string type_name;  ///< "nav_msgs/msg/Odometry", "rcl_interfaces/srv/GetParameters"; wire name for kOther
  bool is_writer = false;
  interfaces::Qos qos;    ///< reliability and durability only
  std::string type_hash;  ///< "RIHS01_..."; empty: unknown
  std::string gid;        ///< hexadecimal
};

/// A node of another process.
struct GraphNode {
  std::string name_space, name;
  std::vector<std::string> readers, writers;  ///< their gids
};

/// Currently known nodes and endpoints of other processes.
struct Graph {
  std::vector<GraphNode> nodes;
  std::vector<GraphEndpoint> endpoints;
  std::vector<std::string> participants;  ///< prefixes of their gids
};

/// Whether nothing known of is missing: each participant has endpoints, those that publish nodes have done so, and the
/// endpoints of all nodes are known. Participants that are not yet discovered cannot be missed.
bool is_complete(const Graph& graph);

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "panvo/interfaces/qos.hpp"

namespace panvo::runtime {

/// Topic on which ROS 2 participants publish their nodes.
inline constexpr const char* kNodesTopic = "ros_discovery_info";

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

/// Whether the graph is consistent: each participant has endpoints, every participant with a writer of kNodesTopic has
/// published its nodes, and all endpoints of these nodes are known. Undiscovered participants are not noticed.
bool is_complete(const Graph& graph);

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fast_dds.hpp"
#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime::dds {

/// Contents of a ros_discovery_info message: the nodes of a participant and their endpoints.
struct NodeInfo {
  using Guid = rtps::GUID_t;
  struct Node {
    std::string name_space, name;
    std::vector<Guid> readers, writers;
  };
  Guid participant;
  std::vector<Node> nodes;
};

/// Size of a GID: 24 bytes up to ROS 2 Humble, 16 bytes since Iron. The message is otherwise the same.
inline constexpr std::size_t kHumbleGidSize = 24;
inline constexpr std::size_t kGidSize = 16;
bool is_until_humble(const std::string& ros_distro);

/// Serialises as rmw_dds_common/msg/ParticipantEntitiesInfo, with encapsulation.
interfaces::Bytes encode(const NodeInfo& info, std::size_t gid_size);

/// Accepts both GID sizes; nullopt for malformed bytes.
std::optional<NodeInfo> decode_node_info(std::span<const std::uint8_t> bytes);

/// The 16 bytes of a GUID in hexadecimal.
std::string hexadecimal(const rtps::GUID_t& guid);

}  // namespace panvo::runtime::dds

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "panvo/interfaces/message_type.hpp"

namespace panvo::runtime::dds {

/// What a message on ros_discovery_info says: the nodes of a participant, and which endpoints are whose.
struct NodeInfo {
  using Guid = eprosima::fastrtps::rtps::GUID_t;
  struct Node {
    std::string name_space, name;
    std::vector<Guid> readers, writers;
  };
  Guid participant;
  std::vector<Node> nodes;
};

/// ROS 2 wrote an endpoint's identity as 24 bytes until Humble, as 16 since Iron; nothing else differs.
inline constexpr std::size_t kHumbleGidSize = 24;
inline constexpr std::size_t kGidSize = 16;
std::size_t gid_size_of(const std::string& ros_distro);

/// rmw_dds_common/msg/ParticipantEntitiesInfo, encapsulation included.
interfaces::Bytes encode(const NodeInfo& info, std::size_t gid_size);

/// Reads either size; nullopt for bytes that are no such message.
std::optional<NodeInfo> decode_node_info(std::span<const std::uint8_t> bytes);

/// The 16 bytes of a GUID in hexadecimal.
std::string hexadecimal(const eprosima::fastrtps::rtps::GUID_t& guid);

}  // namespace panvo::runtime::dds

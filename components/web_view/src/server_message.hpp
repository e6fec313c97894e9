// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::web_view {

// What the server of Foxglove's WebSocket protocol sends: JSON texts, and binary frames of little-endian numbers.

/// A topic as offered to clients.
struct Channel {
  std::uint32_t id;
  std::string topic;
  std::string schema_name;  ///< "nav_msgs/msg/Odometry"
  std::string schema;       ///< in ROS 2's .msg notation; empty: unknown here
};

enum class StatusLevel { kInfo = 0, kWarning = 1, kError = 2 };

/// `capabilities`: of the protocol, such as "clientPublish". `session` identifies this run of the server.
std::string server_info(std::string_view name, const std::vector<std::string>& capabilities, std::string_view session);
std::string status(StatusLevel level, std::string_view message);
std::string advertise(std::span<const Channel> channels);
std::string unadvertise(std::span<const std::uint32_t> channels);

/// Head of a message of a subscription; the payload follows. `time_ns`: of reception.
std::vector<std::uint8_t> message_head(std::uint32_t subscription, std::int64_t time_ns);

}  // namespace panvo::web_view

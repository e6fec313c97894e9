// SPDX-License-Identifier: Apache-2.0
#include "server_message.hpp"

#include <nlohmann/json.hpp>

#include "little_endian.hpp"

namespace panvo::web_view {
namespace {

using nlohmann::json;

constexpr const char* kEncoding = "cdr";
constexpr const char* kSchemaEncoding = "ros2msg";

/// Names of other processes may be invalid UTF-8, which is replaced.
std::string serialized(const json& object) { return object.dump(-1, ' ', false, json::error_handler_t::replace); }

}  // namespace

std::string server_info(std::string_view name, const std::vector<std::string>& capabilities, std::string_view session) {
  return serialized({{"op", "serverInfo"},
                     {"name", name},
                     {"capabilities", capabilities},
                     {"supportedEncodings", {kEncoding}},
                     {"metadata", json::object()},
                     {"sessionId", session}});
}

std::string status(StatusLevel level, std::string_view message) {
  return serialized({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string advertise(std::span<const Channel> channels) {
  json list = json::array();
  for (const auto& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", kEncoding},
                    {"schemaName", channel.schema_name},
                    {"schema", channel.schema},
                    {"schemaEncoding", kSchemaEncoding}});
  }
  return serialized({{"op", "advertise"}, {"channels", list}});
}

std::string unadvertise(std::span<const std::uint32_t> channels) {
  return serialized({{"op", "unadvertise"}, {"channelIds", std::vector(channels.begin(), channels.end())}});
}

std::vector<std::uint8_t> message_head(std::uint32_t subscription, std::int64_t time_ns) {
  std::vector<std::uint8_t> head{1};
  append(head, subscription);
  append(head, static_cast<std::uint64_t>(time_ns));
  return head;
}

}  // namespace panvo::web_view

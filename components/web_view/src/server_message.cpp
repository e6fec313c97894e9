// SPDX-License-Identifier: Apache-2.0
#include "server_message.hpp"

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "little_endian.hpp"
#include "omg_idl.hpp"

namespace panvo::web_view {
namespace {

using nlohmann::json;

constexpr const char* kEncoding = "cdr";
constexpr const char* kRosDistro = "jazzy";  // that of the standard messages

/// Names of other processes may be invalid UTF-8, which is replaced.
std::string serialized(const json& object) { return object.dump(-1, ' ', false, json::error_handler_t::replace); }

/// JavaScript cannot tell 1.0 from 1, so the type is named where it matters.
json shown(const Parameter& parameter) {
  json entry{{"name", parameter.name}};
  std::visit(
      [&](const auto& value) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::monostate>) entry["value"] = value;
      },
      parameter.value);
  if (std::holds_alternative<double>(parameter.value)) entry["type"] = "float64";
  if (std::holds_alternative<std::vector<double>>(parameter.value)) entry["type"] = "float64_array";
  return entry;
}

/// Encoding of messages of a type, and its definition: empty if the type is not known here.
json message_schema(const std::string& name, const interfaces::MessageType* type, SchemaNotation notation) {
  const auto definition = type ? type->definition : std::string_view();
  if (notation == SchemaNotation::kRos2msg)
    return {{"encoding", kEncoding}, {"schemaName", name}, {"schemaEncoding", "ros2msg"}, {"schema", definition}};
  return {{"encoding", kEncoding},
          {"schemaName", idl_name(name)},
          {"schemaEncoding", "omgidl"},
          {"schema", type ? idl_definition(name, definition) : ""}};
}

json message_schema(const std::string& name, SchemaNotation notation) {
  return message_schema(name, interfaces::find_message_type(name), notation);
}

/// Entries that are new or have other nodes; those without nodes left are listed empty unless `is_removed`.
template <class IsRemoved>
json changed(const ConnectionGraph::Links& before, const ConnectionGraph::Links& now, const char* ids_key,
             IsRemoved is_removed) {
  json list = json::array();
  for (const auto& [name, nodes] : now) {
    const auto known = before.find(name);
    if (known == before.end() || known->second != nodes) list.push_back({{"name", name}, {ids_key, nodes}});
  }
  for (const auto& [name, nodes] : before) {
    if (!now.contains(name) && !is_removed(name)) list.push_back({{"name", name}, {ids_key, json::array()}});
  }
  return list;
}

/// Frame of an asset, successful or not.
std::vector<std::uint8_t> asset(std::uint32_t request, std::uint8_t status, std::string_view why,
                                std::string_view content) {
  std::vector<std::uint8_t> frame{4};
  append(frame, request);
  frame.push_back(status);
  append(frame, static_cast<std::uint32_t>(why.size()));
  frame.insert(frame.end(), why.begin(), why.end());
  frame.insert(frame.end(), content.begin(), content.end());
  return frame;
}

json time_of(std::int64_t stamp_ns) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return {{"sec", stamp_ns / kSecond}, {"nsec", stamp_ns % kSecond}};
}

}  // namespace

std::string server_info(std::string_view name, const std::vector<std::string>& capabilities, std::string_view session,
                        const std::optional<runtime::StampRange>& range) {
  // Lichtblick publishes poses only to a server that names a distribution of ROS. It then also has types of Humble, and
  // complains if those of Jazzy have more constants; a client that may only read is spared this.
  json metadata = json::object();
  if (std::ranges::find(capabilities, "clientPublish") != capabilities.end()) metadata["ROS_DISTRO"] = kRosDistro;
  json info{{"op", "serverInfo"},           {"name", name},
            {"capabilities", capabilities}, {"supportedEncodings", {kEncoding}},
            {"metadata", metadata},         {"sessionId", session}};
  if (range) {
    info["dataStartTime"] = time_of(range->first_ns);
    info["dataEndTime"] = time_of(range->last_ns);
  }
  return serialized(info);
}

std::string status(StatusLevel level, std::string_view message) {
  return serialized({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string advertise(std::span<const Channel> channels, SchemaNotation notation) {
  json list = json::array();
  for (const auto& channel : channels) {
    json entry = message_schema(channel.what.type_name, channel.what.type, notation);
    entry["id"] = channel.id;
    entry["topic"] = channel.what.name;
    list.push_back(std::move(entry));
  }
  return serialized({{"op", "advertise"}, {"channels", list}});
}

std::string unadvertise(std::span<const std::uint32_t> channels) {
  return serialized({{"op", "unadvertise"}, {"channelIds", std::vector(channels.begin(), channels.end())}});
}

std::string advertise_services(std::span<const OfferedService> services, SchemaNotation notation) {
  json list = json::array();
  for (const auto& service : services) {
    list.push_back({{"id", service.id},
                    {"name", service.what.name},
                    {"type", service.what.type_name},
                    {"request", message_schema(service.what.type_name + "_Request", notation)},
                    {"response", message_schema(service.what.type_name + "_Response", notation)}});
  }
  return serialized({{"op", "advertiseServices"}, {"services", list}});
}

std::string unadvertise_services(std::span<const std::uint32_t> services) {
  return serialized({{"op", "unadvertiseServices"}, {"serviceIds", std::vector(services.begin(), services.end())}});
}

std::string parameter_values(std::span<const Parameter> parameters, std::string_view id) {
  json list = json::array();
  for (const auto& parameter : parameters) list.push_back(shown(parameter));
  json object{{"op", "parameterValues"}, {"parameters", list}};
  if (!id.empty()) object["id"] = id;
  return serialized(object);
}

std::string service_failure(std::uint32_t service, std::uint32_t call, std::string_view why) {
  return serialized({{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", why}});
}

std::string connection_graph_update(const ConnectionGraph& before, const ConnectionGraph& now) {
  const auto is_removed = [&](const std::string& topic) {
    return !now.published.contains(topic) && !now.subscribed.contains(topic);
  };
  std::set<std::string> removed_topics, removed_services;
  for (const auto* links : {&before.published, &before.subscribed}) {
    for (const auto& [topic, nodes] : *links) {
      if (is_removed(topic)) removed_topics.insert(topic);
    }
  }
  for (const auto& [service, nodes] : before.services) {
    if (!now.services.contains(service)) removed_services.insert(service);
  }
  return serialized({{"op", "connectionGraphUpdate"},
                     {"publishedTopics", changed(before.published, now.published, "publisherIds", is_removed)},
                     {"subscribedTopics", changed(before.subscribed, now.subscribed, "subscriberIds", is_removed)},
                     {"advertisedServices",
                      changed(before.services, now.services, "providerIds", [](const std::string&) { return true; })},
                     {"removedTopics", removed_topics},
                     {"removedServices", removed_services}});
}

std::vector<std::uint8_t> message_head(std::uint32_t subscription, std::int64_t time_ns) {
  std::vector<std::uint8_t> head{1};
  append(head, subscription);
  append(head, static_cast<std::uint64_t>(time_ns));
  return head;
}

std::vector<std::uint8_t> service_response_head(std::uint32_t service, std::uint32_t call) {
  constexpr std::string_view kName = kEncoding;
  std::vector<std::uint8_t> head{3};
  append(head, service);
  append(head, call);
  append(head, static_cast<std::uint32_t>(kName.size()));
  head.insert(head.end(), kName.begin(), kName.end());
  return head;
}

std::vector<std::uint8_t> time_frame(std::int64_t time_ns) {
  std::vector<std::uint8_t> frame{2};
  append(frame, static_cast<std::uint64_t>(time_ns));
  return frame;
}

std::vector<std::uint8_t> playback_frame(const PlaybackState& state, bool is_moved, std::string_view id) {
  std::vector<std::uint8_t> frame{5, static_cast<std::uint8_t>(state.status)};
  append(frame, static_cast<std::uint64_t>(state.time_ns));
  append(frame, std::bit_cast<std::uint32_t>(static_cast<float>(state.speed)));
  frame.push_back(is_moved ? 1 : 0);
  append(frame, static_cast<std::uint32_t>(id.size()));
  frame.insert(frame.end(), id.begin(), id.end());
  return frame;
}

std::vector<std::uint8_t> asset_frame(std::uint32_t request, std::string_view content) {
  return asset(request, 0, "", content);
}

std::vector<std::uint8_t> asset_failure(std::uint32_t request, std::string_view why) {
  return asset(request, 1, why, "");
}

}  // namespace panvo::web_view

// SPDX-License-Identifier: Apache-2.0
#include "client_request.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>

#include "little_endian.hpp"
#include "protocol_error.hpp"

namespace panvo::web_view {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxNameLength = 1000;  // of topics, types and parameters, for which no client needs more

const json& member(const json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) throw ProtocolError(std::string("member ") + name + " is missing");
  return *found;
}

std::uint32_t id_of(const json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
    throw ProtocolError("an id is not an integer from 0 to 4294967295");
  return value.get<std::uint32_t>();
}

std::string text_of(const json& value) {
  if (!value.is_string()) throw ProtocolError("a name is not a string");
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > kMaxNameLength) throw ProtocolError("a name is longer than 1000 bytes");
  return text;
}

std::string optional_text(const json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() || found->is_null() ? "" : text_of(*found);
}

/// Viewers may leave out the "msg" of "package/msg/Type".
std::string type_name_of(const json& value) {
  std::string name = text_of(value);
  const auto slash = name.find('/');
  if (slash != std::string::npos && name.find('/', slash + 1) == std::string::npos) name.insert(slash, "/msg");
  return name;
}

/// Converts each element of a list.
template <class Convert>
auto list_of(const json& object, const char* name, Convert convert) {
  const json& list = member(object, name);
  if (!list.is_array()) throw ProtocolError(std::string("member ") + name + " is not a list");
  std::vector<decltype(convert(list))> all;
  for (const auto& one : list) all.push_back(convert(one));
  return all;
}

const json& object_of(const json& value) {
  if (!value.is_object()) throw ProtocolError("an element of a list is not an object");
  return value;
}

std::int64_t integer_of(const json& value) {
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max())
    throw ProtocolError("an integer is larger than 9223372036854775807");
  return value.get<std::int64_t>();
}

template <class Value>
std::vector<Value> values_of(const json& list) {
  std::vector<Value> values;
  for (const auto& value : list) values.push_back(value.get<Value>());
  return values;
}

ParameterValue list_value(const json& list, bool is_double) {
  const auto all = [&](auto is_it) { return std::ranges::all_of(list, is_it); };
  const bool are_integers = all([](const json& value) { return value.is_number_integer(); });
  if (are_integers && !is_double) {
    std::vector<std::int64_t> integers;
    for (const auto& value : list) integers.push_back(integer_of(value));
    return integers;
  }
  if (all([](const json& value) { return value.is_number(); })) return values_of<double>(list);
  if (all([](const json& value) { return value.is_boolean(); })) return values_of<bool>(list);
  if (all([](const json& value) { return value.is_string(); })) return values_of<std::string>(list);
  throw ProtocolError("the elements of a parameter's list are not of one type");
}

/// JavaScript writes 1.0 as 1, so clients name the type of such values.
Parameter parameter_of(const json& entry) {
  const json& object = object_of(entry);
  Parameter parameter{text_of(member(object, "name")), {}};
  const std::string type = optional_text(object, "type");
  const bool is_double = type == "float64" || type == "float64_array";
  const auto found = object.find("value");
  if (found == object.end() || found->is_null()) return parameter;
  const json& value = *found;
  if (value.is_boolean()) {
    parameter.value = value.get<bool>();
  } else if (value.is_number_integer() && !is_double) {
    parameter.value = integer_of(value);
  } else if (value.is_number()) {
    parameter.value = value.get<double>();
  } else if (value.is_string()) {
    parameter.value = value.get<std::string>();
  } else if (value.is_array()) {
    parameter.value = list_value(value, is_double);
  } else {
    throw ProtocolError("the value of parameter " + parameter.name + " is an object");
  }
  return parameter;
}

ClientRequest request_of(const json& object) {
  const std::string operation = text_of(member(object, "op"));
  if (operation == "subscribe") {
    return Subscribe{list_of(object, "subscriptions", [](const json& one) {
      return Subscribe::One{id_of(member(object_of(one), "id")), id_of(member(one, "channelId"))};
    })};
  }
  if (operation == "unsubscribe") return Unsubscribe{list_of(object, "subscriptionIds", id_of)};
  if (operation == "advertise") {
    return Advertise{list_of(object, "channels", [](const json& one) {
      return Advertise::One{id_of(member(object_of(one), "id")), text_of(member(one, "topic")),
                            text_of(member(one, "encoding")), type_name_of(member(one, "schemaName"))};
    })};
  }
  if (operation == "unadvertise") return Unadvertise{list_of(object, "channelIds", id_of)};
  if (operation == "getParameters")
    return GetParameters{list_of(object, "parameterNames", text_of), optional_text(object, "id")};
  if (operation == "setParameters")
    return SetParameters{list_of(object, "parameters", parameter_of), optional_text(object, "id")};
  if (operation == "subscribeParameterUpdates" || operation == "unsubscribeParameterUpdates")
    return WatchParameters{list_of(object, "parameterNames", text_of), operation == "subscribeParameterUpdates"};
  if (operation == "subscribeConnectionGraph") return WatchConnectionGraph{true};
  if (operation == "unsubscribeConnectionGraph") return WatchConnectionGraph{false};
  if (operation == "fetchAsset") return FetchAsset{text_of(member(object, "uri")), id_of(member(object, "requestId"))};
  throw ProtocolError("operation " + operation.substr(0, 40) + " is not supported");
}

}  // namespace

ClientRequest parse_text(std::string_view frame) {
  const json object = json::parse(frame, nullptr, false);
  if (object.is_discarded()) throw ProtocolError("a text message is not JSON");
  if (!object.is_object()) throw ProtocolError("a text message is not a JSON object");
  return request_of(object);
}

namespace {

/// Command, speed, whether to move, where to, and the id with its length.
ControlPlayback control_of(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kSpeed = 1, kMoves = 5, kTime = 6, kIdLength = 14, kId = 18;
  constexpr std::uint8_t kPlay = 0, kPause = 1;
  if (bytes.size() < kId || bytes.size() - kId < read_u32(bytes.subspan(kIdLength)))
    throw ProtocolError("a binary message is cut off");
  if (bytes[0] != kPlay && bytes[0] != kPause)
    throw ProtocolError("playback command " + std::to_string(bytes[0]) + " is not supported");
  const std::uint64_t time_ns = read_u64(bytes.subspan(kTime));
  const bool moves = bytes[kMoves] != 0;
  if (moves && time_ns > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
    throw ProtocolError("a time to seek is out of range");
  const auto id = bytes.subspan(kId, read_u32(bytes.subspan(kIdLength)));
  if (id.size() > kMaxNameLength) throw ProtocolError("an id is longer than 1000 bytes");
  return {bytes[0] == kPlay,
          std::bit_cast<float>(read_u32(bytes.subspan(kSpeed))),
          moves ? std::optional(static_cast<std::int64_t>(time_ns)) : std::nullopt,
          {id.begin(), id.end()}};
}

}  // namespace

ClientRequest parse_binary(std::span<const std::uint8_t> frame) {
  constexpr std::uint8_t kPublish = 1, kCallService = 2, kControlPlayback = 3;
  if (frame.empty()) throw ProtocolError("a binary message is empty");
  const auto need = [&](std::size_t bytes) {
    if (frame.size() < bytes) throw ProtocolError("a binary message is cut off");
  };
  if (frame[0] == kPublish) {
    need(5);
    return Publish{read_u32(frame.subspan(1)), frame.subspan(5)};
  }
  if (frame[0] == kCallService) {
    need(13);
    const std::uint64_t length = read_u32(frame.subspan(9));
    need(13 + length);
    const auto encoding = frame.subspan(13, length);
    return CallService{read_u32(frame.subspan(1)),
                       read_u32(frame.subspan(5)),
                       {encoding.begin(), encoding.end()},
                       frame.subspan(13 + length)};
  }
  if (frame[0] == kControlPlayback) return control_of(frame.subspan(1));
  throw ProtocolError("binary operation " + std::to_string(frame[0]) + " is not supported");
}

}  // namespace panvo::web_view

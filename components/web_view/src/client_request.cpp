// SPDX-License-Identifier: Apache-2.0
#include "client_request.hpp"

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
                            text_of(member(one, "encoding")), text_of(member(one, "schemaName"))};
    })};
  }
  if (operation == "unadvertise") return Unadvertise{list_of(object, "channelIds", id_of)};
  throw ProtocolError("operation " + operation.substr(0, 40) + " is not supported");
}

}  // namespace

ClientRequest parse_text(std::string_view frame) {
  const json object = json::parse(frame, nullptr, false);
  if (object.is_discarded()) throw ProtocolError("a text message is not JSON");
  if (!object.is_object()) throw ProtocolError("a text message is not a JSON object");
  return request_of(object);
}

ClientRequest parse_binary(std::span<const std::uint8_t> frame) {
  constexpr std::uint8_t kPublish = 1;
  if (frame.empty()) throw ProtocolError("a binary message is empty");
  if (frame[0] == kPublish) {
    if (frame.size() < 5) throw ProtocolError("a binary message is cut off");
    return Publish{read_u32(frame.subspan(1)), frame.subspan(5)};
  }
  throw ProtocolError("binary operation " + std::to_string(frame[0]) + " is not supported");
}

}  // namespace panvo::web_view

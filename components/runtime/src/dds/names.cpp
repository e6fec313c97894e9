// SPDX-License-Identifier: Apache-2.0
#include "names.hpp"

#include <regex>

namespace panvo::runtime::dds {
namespace {

constexpr std::string_view kTopicPrefix = "rt/";

std::optional<std::string> rewrite(std::string_view name, const std::regex& form, const char* format) {
  constexpr std::size_t kLongest = 1000;  // DDS has 255; std::regex needs stack for each letter
  if (name.size() > kLongest) return std::nullopt;
  const std::string text(name);
  std::smatch match;
  if (!std::regex_match(text, match, form)) return std::nullopt;
  return match.format(format);
}

std::string wrapped(std::string_view prefix, std::string_view name, std::string_view suffix) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return std::string(prefix).append(name).append(suffix);
}

std::optional<std::string> unwrapped(std::string_view prefix, std::string_view name, std::string_view suffix) {
  if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) || !name.ends_with(suffix))
    return std::nullopt;
  return std::string("/").append(name.substr(prefix.size(), name.size() - prefix.size() - suffix.size()));
}

}  // namespace

std::string wire_topic_name(std::string_view name) { return wrapped(kTopicPrefix, name, ""); }

std::optional<std::string> topic_name_from_wire(std::string_view wire_name) {
  if (!wire_name.starts_with(kTopicPrefix)) return std::nullopt;
  return std::string("/").append(wire_name.substr(kTopicPrefix.size()));
}

std::optional<std::string> wire_type_name(std::string_view name) {
  static const std::regex kForm(R"((\w+)/(\w+)/(\w+))");
  return rewrite(name, kForm, "$1::$2::dds_::$3_");
}

std::optional<std::string> type_name_from_wire(std::string_view wire_name) {
  static const std::regex kForm(R"((\w+)::(\w+)::dds_::(\w+)_)");
  return rewrite(wire_name, kForm, "$1/$2/$3");
}

std::string wire_request_name(std::string_view service) { return wrapped("rq/", service, "Request"); }
std::string wire_reply_name(std::string_view service) { return wrapped("rr/", service, "Reply"); }

std::optional<std::string> service_from_wire_request(std::string_view wire_name) {
  return unwrapped("rq/", wire_name, "Request");
}
std::optional<std::string> service_from_wire_reply(std::string_view wire_name) {
  return unwrapped("rr/", wire_name, "Reply");
}

std::string service_type_name(std::string_view type_name) {
  for (const std::string_view end : {"_Request", "_Response"}) {
    if (type_name.ends_with(end)) return std::string(type_name.substr(0, type_name.size() - end.size()));
  }
  return std::string(type_name);
}

}  // namespace panvo::runtime::dds

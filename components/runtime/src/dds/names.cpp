// SPDX-License-Identifier: Apache-2.0
#include "names.hpp"

#include <regex>

namespace panvo::runtime::dds {
namespace {

constexpr std::string_view kTopicPrefix = "rt/";

std::optional<std::string> rewrite(std::string_view name, const std::regex& form, const char* format) {
  const std::string text(name);
  std::smatch match;
  if (!std::regex_match(text, match, form)) return std::nullopt;
  return match.format(format);
}

}  // namespace

std::string wire_topic_name(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return std::string(kTopicPrefix).append(name);
}

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

}  // namespace panvo::runtime::dds

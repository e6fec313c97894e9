// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace panvo::landmarks {

/// Everything a description depends on, as text by key: the parameters and the seed. Two descriptions are comparable
/// only if their settings are equal; otherwise the same row of the measurement matrix is a different feature.
using DescriptionSettings = std::map<std::string, std::string>;

/// The shortest text that reads back as the same number.
template <class Number>
std::string settings_text(Number number) {
  if constexpr (std::is_same_v<Number, bool>) {
    return number ? "true" : "false";
  } else {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
  }
}
inline std::string settings_text(const std::string& text) { return text; }

/// Parses `text` into `value`. Returns false for invalid text; a number then stays unchanged.
template <class Number>
bool read_setting(const std::string& text, Number& value) {
  if constexpr (std::is_same_v<Number, bool>) {
    value = text == "true";
    return text == "true" || text == "false";
  } else {
    const auto end = text.data() + text.size();
    return std::from_chars(text.data(), end, value).ptr == end && !text.empty();
  }
}
inline bool read_setting(const std::string& text, std::string& value) {
  value = text;
  return true;
}

namespace detail {

/// Calls `visit` with member pointer and name for every field that a parameter struct declares in its `describe`.
template <class Visit>
struct SettingsField {
  Visit visit;

  template <class Member, class... Rest>
  void operator()(Member member, const char* name, const Rest&...) {
    visit(member, name);
  }
  template <class Member>
  void operator()(Member member, const char* name, const char*, const char*, std::initializer_list<const char*>) {
    visit(member, name);
  }
};
template <class Visit>
SettingsField(Visit) -> SettingsField<Visit>;

}  // namespace detail

/// Settings of a parameter struct (its fields declared in `describe`) and of the seed of the measurement matrix.
template <class Parameters>
DescriptionSettings description_settings(const Parameters& parameters, std::uint64_t seed) {
  DescriptionSettings settings{{"seed", settings_text(seed)}};
  Parameters::describe(detail::SettingsField{
      [&](auto member, const char* name) { settings.emplace(name, settings_text(parameters.*member)); }});
  return settings;
}

/// Parameter struct and seed restored from settings; nullopt if a key is missing or its value invalid.
template <class Parameters>
std::optional<std::pair<Parameters, std::uint64_t>> from_settings(const DescriptionSettings& settings) {
  std::pair<Parameters, std::uint64_t> read{};
  bool is_whole = true;
  const auto take = [&](const std::string& name, auto& value) {
    const auto found = settings.find(name);
    is_whole = is_whole && found != settings.end() && read_setting(found->second, value);
  };
  Parameters::describe(detail::SettingsField{[&](auto member, const char* name) { take(name, read.first.*member); }});
  take("seed", read.second);
  return is_whole ? std::optional(read) : std::nullopt;
}

/// One sentence per key that differs or is missing on one side, e.g. "band_rows is 150 there, 160 here", in order of
/// keys.
std::vector<std::string> differences(const DescriptionSettings& there, const DescriptionSettings& here);

/// Conversion to and from "key=value" lines; a line without "=" is a key without a value. Keys and values must not
/// contain line breaks.
std::string to_text(const DescriptionSettings& settings);
DescriptionSettings settings_from_text(std::string_view text);

}  // namespace panvo::landmarks

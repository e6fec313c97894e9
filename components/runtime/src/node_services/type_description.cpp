// SPDX-License-Identifier: Apache-2.0
#include "node_services/type_description.hpp"
#include "panvo/interfaces/message_type.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <utility>

namespace panvo::runtime::node_services {
namespace {

using type_description_interfaces::msg::Field;
using type_description_interfaces::msg::FieldType;
using type_description_interfaces::msg::IndividualTypeDescription;
using type_description_interfaces::msg::TypeDescription;
using type_description_interfaces::msg::TypeSource;

// The constants of type_description_interfaces/msg/FieldType.
constexpr std::uint8_t kNested = 1, kString = 17, kBoundedString = 21;
constexpr std::uint8_t kArray = 48, kBoundedSequence = 96, kSequence = 144;
constexpr std::pair<std::string_view, std::uint8_t> kPrimitives[] = {
    {"int8", 2},   {"uint8", 3},    {"int16", 4},    {"uint16", 5}, {"int32", 6}, {"uint32", 7},      {"int64", 8},
    {"uint64", 9}, {"float32", 10}, {"float64", 11}, {"bool", 15},  {"byte", 16}, {"string", kString}};

// ROS 2 adds it to messages without members.
constexpr const char* kPlaceholder = "structure_needs_at_least_one_member";

struct Part {
  std::string name;  // "std_msgs/msg/Header"
  std::string_view text;
};

/// The type itself, then the types that it contains, as in the definition: separated by a line, then "MSG: std_msgs/Header".
std::vector<Part> parts_of(const interfaces::MessageType& type) {
  static const std::string separator = "\n" + std::string(80, '=') + "\nMSG: ";
  std::vector<Part> parts{{std::string(type.name), type.definition}};
  for (auto at = std::string_view::npos; (at = parts.back().text.find(separator)) != std::string_view::npos;) {
    auto rest = parts.back().text.substr(at + separator.size());
    parts.back().text = parts.back().text.substr(0, at);
    const auto line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const auto slash = line.find('/');
    parts.push_back({std::string(line.substr(0, slash)) + "/msg" + std::string(line.substr(slash)), rest});
  }
  return parts;
}

/// Removes the next word from the text; empty at its end.
std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlank = " \t";
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(kBlank)));
  const auto word = text.substr(0, text.find_first_of(kBlank));
  text.remove_prefix(word.size());
  return word;
}

std::uint64_t number_of(std::string_view digits) {
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

/// "float64", "string<=5", "Header[]", "geometry_msgs/Point[<=3]", "uint8[16]" within a message of `package`.
FieldType type_of(std::string_view text, std::string_view package) {
  FieldType type;
  std::uint8_t many = 0;
  if (const auto bracket = text.find('['); bracket != std::string_view::npos) {
    auto size = text.substr(bracket + 1, text.size() - bracket - 2);
    many = size.empty() ? kSequence : size.starts_with("<=") ? kBoundedSequence : kArray;
    if (size.starts_with("<=")) size.remove_prefix(2);
    type.capacity(number_of(size));
    text = text.substr(0, bracket);
  }
  std::uint8_t base = kNested;
  if (const auto bound = text.find("<="); bound != std::string_view::npos) {
    base = kBoundedString;
    type.string_capacity(number_of(text.substr(bound + 2)));
  } else if (const auto found = std::ranges::find(kPrimitives, text, [](const auto& known) { return known.first; });
             found != std::end(kPrimitives)) {
    base = found->second;
  } else {
    const auto slash = text.find('/');
    const auto owner = slash == std::string_view::npos ? package : text.substr(0, slash);
    const auto name = slash == std::string_view::npos ? text : text.substr(slash + 1);
    type.nested_type_name(std::string(owner) + "/msg/" + std::string(name));
  }
  type.type_id(static_cast<std::uint8_t>(base + many));
  return type;
}

/// A line without its comment; a '#' within quotes is none.
std::string_view without_comment(std::string_view line) {
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') is_quoted = !is_quoted;
    if (line[i] == '#' && !is_quoted) return line.substr(0, i);
  }
  return line;
}

IndividualTypeDescription description_of(const Part& part) {
  IndividualTypeDescription description;
  description.type_name(part.name);
  const std::string_view package = std::string_view(part.name).substr(0, part.name.find('/'));
  for (auto text = part.text; !text.empty();) {
    auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    line = without_comment(line);
    const auto type = take_word(line), name = take_word(line);
    if (name.empty() || name.find('=') != std::string_view::npos) continue;  // no field, or a constant
    Field field;
    field.name(std::string(name));
    field.type(type_of(type, package));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(' ')));
    line = line.substr(0, line.find_last_not_of(' ') + 1);
    field.default_value(std::string(line));
    description.fields().push_back(field);
  }
  if (description.fields().empty()) {
    Field placeholder;
    placeholder.name(kPlaceholder);
    placeholder.type(type_of("uint8", package));
    description.fields().push_back(placeholder);
  }
  return description;
}

}  // namespace

TypeDescription describe_type(const interfaces::MessageType& type) {
  TypeDescription description;
  const auto parts = parts_of(type);
  description.type_description(description_of(parts.front()));
  auto& contained = description.referenced_type_descriptions();
  for (std::size_t i = 1; i < parts.size(); ++i) contained.push_back(description_of(parts[i]));
  std::ranges::sort(contained, {}, [](const IndividualTypeDescription& one) { return std::string(one.type_name()); });
  return description;
}

std::vector<TypeSource> sources_of(const interfaces::MessageType& type) {
  std::vector<TypeSource> sources;
  for (const auto& part : parts_of(type)) {
    TypeSource source;
    source.type_name(part.name);
    source.encoding("msg");
    source.raw_file_contents(std::string(part.text));
    sources.push_back(source);
  }
  return sources;
}

}  // namespace panvo::runtime::node_services

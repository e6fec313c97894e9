// SPDX-License-Identifier: Apache-2.0
#include "omg_idl.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace panvo::web_view {
namespace {

constexpr std::string_view kBlank = " \t\r";

/// A type of a member: "string<=8[<=3]" is a sequence of up to three strings.
struct MemberType {
  std::string base;        // of IDL
  std::string nested;      // "std_msgs/msg/Header" if it is a message, else empty
  std::string array_size;  // "36"; empty: no array
  bool is_sequence = false;
  std::string sequence_bound;
};

struct Struct {
  std::string name;                             // "nav_msgs/msg/Odometry"
  std::vector<std::string> constants, members;  // lines of IDL
  std::vector<std::string> nested;
};

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// Removes the part up to a separator from the front of `text`, and returns it.
std::string_view take_until(std::string_view& text, std::string_view separators) {
  const auto part = text.substr(0, text.find_first_of(separators));
  text.remove_prefix(part.size());
  return part;
}

/// Name of a primitive type in IDL; empty: it is none.
std::string_view primitive(std::string_view name) {
  constexpr auto kNames = std::to_array<std::pair<std::string_view, std::string_view>>({
      {"bool", "boolean"},
      {"byte", "octet"},
      {"char", "uint8"},
      {"float32", "float"},
      {"float64", "double"},
  });
  constexpr auto kSame = std::to_array<std::string_view>(
      {"string", "wstring", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"});
  const auto* const found = std::ranges::find(kNames, name, &decltype(kNames)::value_type::first);
  if (found != kNames.end()) return found->second;
  return std::ranges::find(kSame, name) != kSame.end() ? name : std::string_view();
}

/// `package`: of the message that contains the member.
MemberType member_type(std::string_view text, std::string_view package) {
  MemberType type;
  const std::string_view base = take_until(text, "<[");
  type.base = primitive(base);
  if (type.base.empty()) {
    const auto slash = base.find('/');
    const auto of = slash == std::string_view::npos ? package : base.substr(0, slash);
    type.nested.append(of).append("/msg/").append(base.substr(slash + 1));  // npos + 1: 0
    type.base = idl_name(type.nested);
  }
  if (text.starts_with("<=")) {
    text.remove_prefix(2);
    type.base.append("<").append(take_until(text, "[")).append(">");
  }
  if (!text.starts_with('[')) return type;
  text = text.substr(1, text.size() - 2);
  type.is_sequence = text.empty() || text.starts_with("<=");
  if (type.is_sequence) {
    type.sequence_bound = text.substr(std::min<std::size_t>(text.size(), 2));
  } else {
    type.array_size = text;
  }
  return type;
}

std::string constant(std::string_view type, std::string_view name, std::string_view value) {
  std::string text(value);
  if (type == "bool") text = value == "true" || value == "True" || value == "1" ? "TRUE" : "FALSE";
  if (type == "string") {
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
      text = text.substr(1, text.size() - 2);
    std::string quoted = "\"";
    for (const char letter : text) {
      if (letter == '"' || letter == '\\') quoted += '\\';
      quoted += letter;
    }
    text = quoted + '"';
  }
  return "const " + std::string(primitive(type)) + ' ' + std::string(name) + " = " + text + ';';
}

void add_line(Struct& to, std::string_view line) {
  line = trimmed(line);
  if (line.empty() || line.starts_with('#')) return;
  const auto type = take_until(line, kBlank);
  line = trimmed(line);
  const auto name = take_until(line, " \t=#");
  line = trimmed(line);
  if (line.starts_with('=')) {
    // Only text may contain the sign that begins a comment elsewhere.
    const auto value = line.substr(1, type == "string" ? std::string_view::npos : line.find('#') - 1);
    to.constants.push_back(constant(type, name, trimmed(value)));
    return;
  }
  const auto package = std::string_view(to.name).substr(0, to.name.find('/'));
  const auto member = member_type(type, package);
  std::string text = member.base;
  if (member.is_sequence)
    text = "sequence<" + text + (member.sequence_bound.empty() ? "" : ", " + member.sequence_bound) + '>';
  text.append(" ").append(name);
  if (!member.array_size.empty()) text += '[' + member.array_size + ']';
  to.members.push_back(text + ';');
  if (!member.nested.empty()) to.nested.push_back(member.nested);
}

/// All types of a definition, by name.
std::map<std::string, Struct> parsed(std::string_view type_name, std::string_view definition) {
  constexpr std::string_view kNext = "MSG: ";
  std::map<std::string, Struct> structs;
  Struct* current = &structs[std::string(type_name)];
  current->name = type_name;
  while (!definition.empty()) {
    const auto line = take_until(definition, "\n");
    definition.remove_prefix(std::min<std::size_t>(1, definition.size()));
    if (line.starts_with("===")) continue;
    if (line.starts_with(kNext)) {
      const auto name = trimmed(line.substr(kNext.size()));
      const auto slash = name.find('/');
      const auto full = std::string(name.substr(0, slash)) + "/msg/" + std::string(name.substr(slash + 1));
      current = &structs[full];
      current->name = full;
    } else {
      add_line(*current, line);
    }
  }
  return structs;
}

void write(const std::map<std::string, Struct>& structs, const std::string& name, std::set<std::string>& written,
           std::string& text) {
  const auto found = structs.find(name);
  if (found == structs.end() || !written.insert(name).second) return;
  const auto& [full_name, content] = *found;
  for (const auto& nested : content.nested) write(structs, nested, written, text);
  const auto first = name.find('/'), last = name.rfind('/');
  const std::string own_name = name.substr(last + 1);
  text += "module " + name.substr(0, first) + " {\nmodule " + name.substr(first + 1, last - first - 1) + " {\n";
  if (!content.constants.empty()) {
    text += "module " + own_name + "_Constants {\n";
    for (const auto& line : content.constants) text += "  " + line + '\n';
    text += "};\n";
  }
  text += "struct " + own_name + " {\n";
  for (const auto& line : content.members) text += "  " + line + '\n';
  // IDL and CDR have no empty struct; ROS 2 puts a byte in its place.
  if (content.members.empty()) text += "  uint8 structure_needs_at_least_one_member;\n";
  text += "};\n};\n};\n";
}

}  // namespace

std::string idl_name(std::string_view type_name) {
  std::string name;
  for (const char letter : type_name) name += letter == '/' ? std::string("::") : std::string(1, letter);
  return name;
}

std::string idl_definition(std::string_view type_name, std::string_view definition) {
  std::string text;
  std::set<std::string> written;
  write(parsed(type_name, definition), std::string(type_name), written, text);
  return text;
}

}  // namespace panvo::web_view

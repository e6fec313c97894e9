// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/names.hpp"

#include <algorithm>
#include <cstddef>

#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {
namespace {

constexpr std::size_t kMaxNameLength = 247;  // DDS's limit (255) minus ROS 2's prefixes such as "rt/"

// Not <cctype>, which depends on the locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::optional<std::string> word_problem(std::string_view word) {
  if (word.empty()) {
    return "has an empty part; write one '/' between words and none at the end";
  }
  if (is_digit(word.front())) {
    return "has a part that begins with a digit; begin it with a letter";
  }
  const auto wrong = std::find_if(word.begin(), word.end(), [](char c) { return !is_letter(c) && !is_digit(c); });
  if (wrong != word.end()) {
    return std::string("has the character '") + *wrong + "'; use letters, digits, '_' and '/' only";
  }
  return std::nullopt;
}

std::optional<std::string> words_problem(std::string_view words) {
  while (true) {
    const std::size_t slash = words.find('/');
    if (auto wrong = word_problem(words.substr(0, slash))) {
      return wrong;
    }
    if (slash == std::string_view::npos) {
      return std::nullopt;
    }
    words.remove_prefix(slash + 1);
  }
}

std::string expand(std::string_view name_space, std::string_view node_name, std::string_view topic) {
  if (topic.starts_with("~/")) {
    return full_name(full_name(name_space, node_name), topic.substr(2));
  }
  return full_name(name_space, topic);
}

bool is_same_topic(std::string_view name_space, std::string_view node_name, std::string_view one,
                   std::string_view other) {
  return expand(name_space, node_name, one) == expand(name_space, node_name, other);
}

void check_topic(std::string_view topic) {
  if (const auto wrong = topic_name_problem(topic)) {
    throw ConfigError("topic name \"" + std::string(topic) + "\" " + *wrong);
  }
}

}  // namespace

std::optional<std::string> topic_name_problem(std::string_view name) {
  if (name.empty()) {
    return "is empty";
  }
  if (name.size() > kMaxNameLength) {
    return "is longer than " + std::to_string(kMaxNameLength) + " characters";
  }
  if (name.starts_with("~/")) {
    return words_problem(name.substr(2));
  }
  return words_problem(name.starts_with('/') ? name.substr(1) : name);
}

std::optional<std::string> node_name_problem(std::string_view name) {
  if (name.empty()) {
    return "is empty";
  }
  if (name.find('/') != std::string_view::npos) {
    return "has a '/'; put the part before it into the key namespace";
  }
  return word_problem(name);
}

std::optional<std::string> package_name_problem(std::string_view name) {
  const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
  const bool is_one = !name.empty() && name.size() <= kMaxNameLength && is_small(name.front()) &&
                      std::ranges::all_of(name, [&](char c) { return is_small(c) || is_digit(c) || c == '_'; });
  if (is_one) return std::nullopt;
  return "is not a package name; use lower-case letters, digits and '_', starting with a letter";
}

std::optional<std::string> class_name_problem(std::string_view name) {
  constexpr std::string_view kColons = "::";
  for (std::size_t colons = name.find(kColons); colons != std::string_view::npos; colons = name.find(kColons)) {
    if (word_problem(name.substr(0, colons))) return "is not a class name; write Class or package::Class";
    name.remove_prefix(colons + kColons.size());
  }
  if (word_problem(name)) return "is not a class name; write Class or package::Class";
  return std::nullopt;
}

std::optional<std::string> name_space_problem(std::string_view name_space) {
  if (name_space.empty() || name_space == "/") {
    return std::nullopt;
  }
  return words_problem(name_space.starts_with('/') ? name_space.substr(1) : name_space);
}

std::string join_name_spaces(std::string_view outer, std::string_view inner) {
  return inner.empty() ? full_name("", outer.empty() ? "/" : outer) : full_name(outer, inner);
}

std::string full_name(std::string_view name_space, std::string_view name) {
  if (name.starts_with('/')) {
    return std::string(name);
  }
  std::string full;
  if (!name_space.empty() && name_space != "/") {
    full.append(name_space.starts_with('/') ? "" : "/").append(name_space);
  }
  return full.append("/").append(name);
}

std::string resolve_topic(std::string_view name_space, std::string_view node_name,
                          const std::map<std::string, std::string>& remaps, std::string_view topic) {
  check_topic(topic);
  std::string resolved = expand(name_space, node_name, topic);
  for (const auto& [from, to] : remaps) {
    if (expand(name_space, node_name, from) == resolved) {
      check_topic(to);
      return expand(name_space, node_name, to);
    }
  }
  return resolved;
}

bool is_remapped(std::string_view name_space, std::string_view node_name,
                 const std::map<std::string, std::string>& remaps, std::string_view topic) {
  return std::ranges::any_of(remaps,
                             [&](const auto& rule) { return is_same_topic(name_space, node_name, rule.first, topic); });
}

void set_remap(std::string_view name_space, std::string_view node_name, std::map<std::string, std::string>& remaps,
               const std::string& from, const std::string& to) {
  std::erase_if(remaps, [&](const auto& rule) { return is_same_topic(name_space, node_name, rule.first, from); });
  remaps[from] = to;
}

}  // namespace panvo::runtime

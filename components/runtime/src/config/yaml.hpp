// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/runtime/parameters.hpp"
#include "panvo/runtime/problems.hpp"
#include "substitution.hpp"

namespace panvo::runtime {

/// Collects the problems and notes of reading a system file and the files it refers to.
struct Findings {
  Problems problems;
  std::vector<std::string> notes;

  void note(const Location& where, const std::string& what) { notes.push_back(where.to_string() + ": " + what); }
};

/// Loads the document in a file. On failure returns nullopt and adds a problem: at the line of a syntax error, or at
/// `named_at`, the position that names the file, if it cannot be read.
std::optional<YAML::Node> load_yaml(const std::filesystem::path& file, const Location& named_at, Findings& findings);

Location location_of(const std::filesystem::path& file, const YAML::Node& node);

/// Reads a scalar or a list of scalars; otherwise returns nullopt and adds a problem. Substitutes if `scope` is given.
std::optional<WrittenValue> written_value(const YAML::Node& node, const std::string& name, const Location& where,
                                          const Scope* scope, Findings& findings);

/// Reads a map of a system file key by key; reports missing, duplicate, unknown and wrongly typed keys.
class YamlMap {
 public:
  /// `what` names the map in messages: "node_container".
  YamlMap(const YAML::Node& node, std::string what, const Scope& scope, Findings& findings);

  /// Whether the node is a map. If not, that is the only problem reported.
  bool is_map() const noexcept { return is_map_; }
  const Location& where() const noexcept { return where_; }
  Location where(const std::string& key) const;
  bool has(const std::string& key) const { return find(key) != nullptr; }

  /// A scalar after substitution.
  std::optional<std::string> text(const std::string& key);
  /// The same for a required, non-empty value; "" otherwise.
  std::string required(const std::string& key, const std::string& remedy);
  bool flag(const std::string& key, bool otherwise);
  std::optional<YAML::Node> node(const std::string& key);
  std::vector<YAML::Node> list(const std::string& key);

  /// Whether it is a map and its `if` and `unless` conditions hold.
  bool applies();

  /// Call after all keys have been read: notes ROS 2 keys without effect here and reports unknown keys.
  void finish(const std::vector<std::string>& without_effect = {});

 private:
  struct Entry {
    std::string key;
    YAML::Node key_node, value;
  };

  const Entry* find(const std::string& key) const;
  const Entry* ask(const std::string& key);
  void problem(const Location& where, const std::string& what) { findings_.problems.add(where, what_ + " " + what); }

  std::string what_;
  const Scope& scope_;
  Findings& findings_;
  Location where_;
  bool is_map_;
  std::vector<Entry> entries_;
  std::vector<std::string> asked_;
};

}  // namespace panvo::runtime

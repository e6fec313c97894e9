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

/// What the readers of a system file and of the files it names report to.
struct Findings {
  Problems problems;
  std::vector<std::string> notes;

  void note(const Location& where, const std::string& what) { notes.push_back(where.to_string() + ": " + what); }
};

/// The document in a file; nullopt, and a problem, if there is none: at the line of the syntax error, or at
/// `named_at`, the place that names the file, when it cannot be read.
std::optional<YAML::Node> load_yaml(const std::filesystem::path& file, const Location& named_at, Findings& findings);

Location location_of(const std::filesystem::path& file, const YAML::Node& node);

/// A scalar or a list of scalars. nullopt, and a problem, for anything else. Substitutes if there is a scope
/// to do it with.
std::optional<WrittenValue> written_value(const YAML::Node& node, const std::string& name, const Location& where,
                                          const Scope* scope, Findings& findings);

/// A map of a system file, taken apart key by key: what is missing, doubled, of the wrong kind or not known
/// is reported.
class YamlMap {
 public:
  /// `what` names the map in messages: "node_container".
  YamlMap(const YAML::Node& node, std::string what, const Scope& scope, Findings& findings);

  /// Whether it was a map at all; if not, it reports nothing more.
  bool is_map() const noexcept { return is_map_; }
  const Location& where() const noexcept { return where_; }
  Location where(const std::string& key) const;
  bool has(const std::string& key) const { return find(key) != nullptr; }

  /// A scalar, substituted.
  std::optional<std::string> text(const std::string& key);
  /// The same where it must be there and not empty; "" else.
  std::string required(const std::string& key, const std::string& remedy);
  bool flag(const std::string& key, bool otherwise);
  std::optional<YAML::Node> node(const std::string& key);
  std::vector<YAML::Node> list(const std::string& key);

  /// Whether it is a map, and its `if` and `unless` let it count.
  bool applies();

  /// To be called when all has been asked for: notes the keys that ROS 2 knows and that have no effect here,
  /// and reports the others.
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

// SPDX-License-Identifier: Apache-2.0
#include "yaml.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "suggestion.hpp"

namespace panvo::runtime {
namespace {

/// Counts nodes with aliases written out: these can make a list contain itself, and a few lines of them stand for
/// billions. Returns whether there are at most `left`, nested at most `deepest` deep.
bool stays_within(const YAML::Node& node, int deepest, std::size_t& left) {
  if (deepest == 0 || left == 0) return false;
  --left;
  const auto item_stays_within = [&](const YAML::Node& item) { return stays_within(item, deepest - 1, left); };
  if (node.IsSequence()) return std::all_of(node.begin(), node.end(), item_stays_within);
  return !node.IsMap() || std::all_of(node.begin(), node.end(), [&](const auto& pair) {
    return item_stays_within(pair.first) && item_stays_within(pair.second);
  });
}

}  // namespace

std::optional<YAML::Node> load_yaml(const std::filesystem::path& file, const Location& named_at, Findings& findings) {
  const auto unreadable = [&](const std::string& why) {
    const auto who = named_at.file == file.string() ? "" : file.string() + ": ";
    findings.problems.add(named_at, who + why);
    return std::nullopt;
  };
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return unreadable("no such file; check the path");
  }
  if (std::filesystem::is_directory(file, error)) {
    return unreadable("is a folder; name a YAML file in it");
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (!stream || !(content << stream.rdbuf())) {
    if (stream.is_open() && content.str().empty() && std::filesystem::file_size(file, error) == 0) {
      return unreadable("is empty");
    }
    return unreadable("cannot be read: " + std::string(std::strerror(errno)));
  }
  constexpr int kDeepest = 100;
  constexpr std::size_t kRepeated = 100'000;  // a file without aliases has no more nodes than characters
  try {
    const YAML::Node root = YAML::Load(content.str());
    std::size_t left = content.str().size() + kRepeated;
    if (stays_within(root, kDeepest, left)) return root;
    findings.problems.add({file.string(), 0},
                          "is nested too deep, or its aliases (*name) repeat too much; remove some");
    return std::nullopt;
  } catch (const YAML::Exception& exception) {
    const int line = exception.mark.is_null() ? 0 : exception.mark.line + 1;
    findings.problems.add({file.string(), line}, "is not YAML: " + exception.msg +
                                                     "; check indentation, colons, brackets and quotes near here");
    return std::nullopt;
  }
}

Location location_of(const std::filesystem::path& file, const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return {file.string(), mark.is_null() ? 0 : mark.line + 1};
}

std::optional<WrittenValue> written_value(const YAML::Node& node, const std::string& name, const Location& where,
                                          const Scope* scope, Findings& findings) {
  WrittenValue written{.items = {}, .is_list = node.IsSequence(), .where = where};
  const auto add_item = [&](const YAML::Node& item) {
    if (!item.IsScalar()) {
      const auto remedy = item.IsNull() ? " has no value; write \"\" for an empty text"
                                        : " must be one value or a list of values, not lists or maps within a list";
      findings.problems.add(where, "parameter " + name + remedy);
      return false;
    }
    try {
      written.items.push_back(scope == nullptr ? item.Scalar() : substitute(item.Scalar(), *scope));
    } catch (const SubstitutionError& error) {
      findings.problems.add(where, "parameter " + name + ": " + error.what());
      return false;
    }
    return true;
  };
  const bool good = written.is_list ? std::all_of(node.begin(), node.end(), add_item) : add_item(node);
  return good ? std::optional(written) : std::nullopt;
}

YamlMap::YamlMap(const YAML::Node& node, std::string what, const Scope& scope, Findings& findings)
    : what_(std::move(what)),
      scope_(scope),
      findings_(findings),
      where_(location_of(scope.file, node)),
      is_map_(node.IsMap()) {
  if (!is_map_) {
    problem(where_, "must be a map: lines \"key: value\"");
    return;
  }
  for (const auto& pair : node) {
    const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "";
    if (const Entry* first = find(key)) {
      problem(location_of(scope.file, pair.first),
              "has \"" + key + "\" twice, first at " + location_of(scope.file, first->key_node).to_string());
      continue;
    }
    entries_.push_back({key, pair.first, pair.second});
  }
}

Location YamlMap::where(const std::string& key) const {
  const Entry* entry = find(key);
  return entry == nullptr ? where_ : location_of(scope_.file, entry->key_node);
}

std::optional<std::string> YamlMap::text(const std::string& key) {
  const Entry* entry = ask(key);
  if (entry == nullptr) {
    return std::nullopt;
  }
  if (!entry->value.IsScalar()) {
    problem(where(key), "key \"" + key + "\" " + (entry->value.IsNull() ? "has no value" : "must be one value"));
    return std::nullopt;
  }
  try {
    return substitute(entry->value.Scalar(), scope_);
  } catch (const SubstitutionError& error) {
    problem(where(key), "key \"" + key + "\": " + error.what());
    return std::nullopt;
  }
}

std::string YamlMap::required(const std::string& key, const std::string& remedy) {
  if (!has(key)) {
    ask(key);
    problem(where_, "lacks the key \"" + key + "\"; " + remedy);
    return "";
  }
  const auto value = text(key);
  if (value && value->empty()) {
    problem(where(key), "key \"" + key + "\" is empty; " + remedy);
  }
  return value.value_or("");
}

bool YamlMap::flag(const std::string& key, bool otherwise) {
  const auto value = text(key);
  if (!value) {
    return otherwise;
  }
  if (*value != "true" && *value != "false" && *value != "1" && *value != "0") {
    problem(where(key), "key \"" + key + "\" = " + *value + ": must be true or false");
    return otherwise;
  }
  return *value == "true" || *value == "1";
}

std::optional<YAML::Node> YamlMap::node(const std::string& key) {
  const Entry* entry = ask(key);
  return entry == nullptr ? std::nullopt : std::optional(entry->value);
}

std::vector<YAML::Node> YamlMap::list(const std::string& key) {
  const Entry* entry = ask(key);
  if (entry == nullptr) {
    return {};
  }
  if (!entry->value.IsSequence()) {
    problem(where(key), "key \"" + key + "\" must be a list: lines that begin with \"- \"");
    return {};
  }
  return {entry->value.begin(), entry->value.end()};
}

bool YamlMap::applies() {
  const bool wanted = flag("if", true);
  return !flag("unless", false) && wanted && is_map_;
}

void YamlMap::finish(const std::vector<std::string>& without_effect) {
  for (const auto& entry : entries_) {
    if (std::find(without_effect.begin(), without_effect.end(), entry.key) != without_effect.end()) {
      findings_.note(where(entry.key), what_ + " key \"" + entry.key + "\" has no effect here");
    } else if (std::find(asked_.begin(), asked_.end(), entry.key) == asked_.end()) {
      problem(where(entry.key), "has no key \"" + entry.key + "\"" + suggestion(entry.key, asked_));
    }
  }
}

const YamlMap::Entry* YamlMap::find(const std::string& key) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&key](const Entry& e) { return e.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

const YamlMap::Entry* YamlMap::ask(const std::string& key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) {
    asked_.push_back(key);
  }
  return find(key);
}

}  // namespace panvo::runtime

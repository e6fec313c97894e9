// SPDX-License-Identifier: Apache-2.0
#include "parameter_file.hpp"

namespace panvo::runtime {
namespace {

constexpr const char* kParameters = "ros__parameters";
constexpr int kDeepest = 16;  // YAML aliases can make a map contain itself

std::pair<std::string_view, std::string_view> split_word(std::string_view path) {
  const auto slash = path.find('/');
  return {path.substr(0, slash), slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1)};
}

bool words_match(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) {
    return name.empty();
  }
  const auto [pattern_word, pattern_rest] = split_word(pattern);
  const auto [word, rest] = split_word(name);
  if (pattern_word == "**") {
    return words_match(pattern_rest, name) || (!name.empty() && words_match(pattern, rest));
  }
  return !name.empty() && (pattern_word == "*" || pattern_word == word) && words_match(pattern_rest, rest);
}

class ParameterFile {
 public:
  ParameterFile(const std::filesystem::path& file, const std::string& node, const Scope* scope, Findings& findings)
      : file_(file), node_(node), scope_(scope), findings_(findings) {}

  void read(const YAML::Node& root, const Location& named_at) {
    read_sections(root, "", 0);
    if (!any_section_) {
      findings_.problems.add({file_.string(), 0},
                             "has no parameters; write the node's name (or \"/**\") and a colon, below it " +
                                 std::string(kParameters) + ":, below that the parameters");
    } else if (!any_for_node_) {
      findings_.note(named_at,
                     file_.string() + " has no parameters for " + node_ + "; its sections are for " + sections_);
    }
  }

  WrittenValues take() { return std::move(values_); }

 private:
  void read_sections(const YAML::Node& map, const std::string& name, int depth) {
    if (!map.IsMap() || depth > kDeepest) {
      problem(map, name.empty() ? "must be a map of node names"
                                : "section " + name + " must be a map with " + std::string(kParameters));
      return;
    }
    for (const auto& pair : map) {
      const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "";
      if (key != kParameters) {
        read_sections(pair.second, name.empty() ? key : std::string(name).append(1, '/').append(key), depth + 1);
        continue;
      }
      any_section_ = true;
      sections_ += (sections_.empty() ? "" : ", ") + name;
      if (section_is_for(name, node_)) {
        any_for_node_ = true;
        is_for_several_ = name.find('*') != std::string::npos;
        read_values(pair.second, "", 0);
      }
    }
  }

  void read_values(const YAML::Node& map, const std::string& prefix, int depth) {
    if (!map.IsMap() || depth > kDeepest) {
      problem(map, (prefix.empty() ? kParameters : prefix) + std::string(" must be a map of parameters"));
      return;
    }
    std::vector<std::string> names;
    for (const auto& pair : map) {
      const std::string name = prefix + (pair.first.IsScalar() ? pair.first.Scalar() : "");
      if (std::find(names.begin(), names.end(), name) != names.end()) {
        problem(pair.first, "parameter " + name + " is given twice in one section; keep one");
        continue;
      }
      names.push_back(name);
      if (pair.second.IsMap()) {
        read_values(pair.second, name + ".", depth + 1);
      } else if (auto value = written_value(pair.second, name, location_of(file_, pair.first), scope_, findings_)) {
        value->is_for_several = is_for_several_;
        values_[name] = std::move(*value);
      }
    }
  }

  void problem(const YAML::Node& node, const std::string& what) {
    findings_.problems.add(location_of(file_, node), what);
  }

  const std::filesystem::path& file_;
  const std::string& node_;
  const Scope* scope_;
  Findings& findings_;
  bool any_section_ = false;
  bool any_for_node_ = false;
  bool is_for_several_ = false;  // the section that is being read
  std::string sections_;
  WrittenValues values_;
};

}  // namespace

bool section_is_for(std::string_view pattern, std::string_view node) {
  const auto slash = pattern.find('/');
  if (slash == std::string_view::npos && pattern.find('*') == std::string_view::npos) {
    return pattern == node.substr(node.rfind('/') + 1);
  }
  return words_match(slash == 0 ? pattern.substr(1) : pattern, node.substr(1));
}

WrittenValues read_parameter_file(const std::filesystem::path& file, const std::string& node, const Scope* scope,
                                  const Location& named_at, Findings& findings) {
  const auto root = load_yaml(file, named_at, findings);
  if (!root) {
    return {};
  }
  ParameterFile reader(file, node, scope, findings);
  reader.read(*root, named_at);
  return reader.take();
}

}  // namespace panvo::runtime

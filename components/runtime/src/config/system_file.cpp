// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/system_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "component_entry.hpp"
#include "node_parameters.hpp"
#include "panvo/runtime/names.hpp"
#include "policies_entry.hpp"
#include "suggestion.hpp"
#include "yaml.hpp"

namespace panvo::runtime {
namespace {

/// ROS 2's keys of processes and nodes that have no effect on our containers.
const std::vector<std::string> kContainerKeysWithoutEffect = {"args", "ros_args",      "output", "respawn_max_retries",
                                                              "env",  "launch-prefix", "remap"};
constexpr int kMaxDelayS = 3600;
constexpr int kMaxImageMb = 64;
constexpr int kMaxMessageMb = 2000;  // Fast DDS counts the bytes of a message in 31 bits
constexpr int kMaxRateHz = 1'000'000;
const std::vector<std::string> kActions = {"node_container",     "arg",      "let", "include", "group",
                                           "push_ros_namespace", "set_remap"};

class SystemReader {
 public:
  SystemDescription read(const std::filesystem::path& file, const std::map<std::string, std::string>& arguments) {
    Given given;
    for (const auto& [name, value] : arguments) {
      given[name] = {value, {file.string(), 0}};
    }
    system_.file = file.string();
    read_file(file, {.file = file}, given, {file.string(), 0});
    if (findings_.problems.empty() && system_.containers.empty()) {
      findings_.problems.add({file.string(), 0}, "loads nothing; add a node_container with composable_node entries");
    }
    findings_.problems.throw_if_any();
    system_.notes = std::move(findings_.notes);
    return std::move(system_);
  }

 private:
  struct Argument {
    std::string value;
    Location where;
  };
  using Given = std::map<std::string, Argument>;

  /// A file being read: its arguments and those it has declared.
  struct File {
    const Given& given;
    std::vector<std::string> declared;
  };

  void read_file(const std::filesystem::path& path, Scope scope, const Given& given, const Location& named_at) {
    if (std::find(open_files_.begin(), open_files_.end(), path) != open_files_.end()) {
      std::string chain;
      for (const auto& open : open_files_) {
        chain += open.string() + " -> ";
      }
      findings_.problems.add(named_at, "the file includes itself: " + chain + path.string() + "; remove one include");
      return;
    }
    const auto root = load_yaml(path, named_at, findings_);
    if (!root) {
      return;
    }
    if (!root->IsMap() || !(*root)["launch"]) {
      findings_.problems.add({path.string(), 0},
                             "has no list \"launch\"; begin it with \"launch:\", below it \"- node_container:\"");
      return;
    }
    open_files_.push_back(path);
    File file{given, {}};
    YamlMap top(*root, "a system file", scope, findings_);
    for (const auto& action : top.list("launch")) {
      read_action(action, scope, file);
    }
    top.finish();
    for (const auto& [name, argument] : given) {
      if (std::find(file.declared.begin(), file.declared.end(), name) == file.declared.end()) {
        findings_.problems.add(argument.where,
                               path.string() + " has no argument \"" + name + "\"" + suggestion(name, file.declared));
      }
    }
    open_files_.pop_back();
  }

  void read_action(const YAML::Node& node, Scope& scope, File& file) {
    if (!node.IsMap() || node.size() != 1 || !node.begin()->first.IsScalar()) {
      findings_.problems.add(
          location_of(scope.file, node),
          "an entry of the list must be one of node_container, arg, let, include, group, with its contents "
          "indented below");
      return;
    }
    const YAML::Node name_node = node.begin()->first;
    const YAML::Node body = node.begin()->second;
    const std::string& name = name_node.Scalar();
    if (name == "group") {
      return read_group(body, scope, file);
    }
    if (std::find(kActions.begin(), kActions.end(), name) == kActions.end()) {
      findings_.problems.add(location_of(scope.file, name_node),
                             "there is no entry \"" + name + "\"" + suggestion(name, kActions));
      return;
    }
    YamlMap map(body, name, scope, findings_);
    if (!map.applies()) {
      return;
    }
    if (name == "node_container") {
      read_container(map, scope);
    } else if (name == "arg") {
      read_argument(map, scope, file);
    } else if (name == "let") {
      const auto variable = map.required("name", "name the variable");
      scope.variables[variable] = map.text("value").value_or("");
      map.finish();
    } else if (name == "include") {
      read_include(map, scope);
    } else if (name == "set_remap") {
      const auto from = read_topic(map, "from", findings_);
      scope.remaps.emplace_back(from, read_topic(map, "to", findings_));
      map.finish();
    } else {
      scope.name_space = read_name_space(map, scope, findings_);
      map.finish();
    }
  }

  /// Variables and namespaces set in a group apply until its end.
  void read_group(const YAML::Node& body, Scope scope, File& file) {
    if (!body.IsSequence()) {
      findings_.problems.add(location_of(scope.file, body), "group must be a list: lines that begin with \"- \"");
      return;
    }
    for (const auto& action : body) {
      read_action(action, scope, file);
    }
  }

  void read_argument(YamlMap& map, Scope& scope, File& file) {
    const auto name = map.required("name", "name the argument");
    const auto otherwise = map.text("default");
    const auto description = map.text("description");
    map.finish({"choice"});
    file.declared.push_back(name);
    if (const auto given = file.given.find(name); given != file.given.end()) {
      scope.variables[name] = given->second.value;
    } else if (otherwise) {
      scope.variables.emplace(name, *otherwise);  // an including file may have set it
    } else if (!scope.variables.contains(name) && !name.empty() && !map.has("default")) {
      findings_.problems.add(map.where(), "argument \"" + name + "\" is not given and has no default" +
                                              (description ? " (" + *description + ")" : "") +
                                              "; pass a value or add a default");
      scope.variables[name] = "";  // avoids follow-up problems where it is used
    }
  }

  void read_include(YamlMap& map, const Scope& scope) {
    const auto file = map.required("file", "name the system file to include");
    Given given;
    for (const auto& node : map.list("arg")) {
      YamlMap entry(node, "arg of an include", scope, findings_);
      if (!entry.is_map()) {
        continue;
      }
      const auto name = entry.required("name", "name the argument");
      given[name] = {entry.text("value").value_or(""), entry.where("name")};
      entry.finish();
    }
    const auto where = map.where("file");
    map.finish();
    if (!file.empty()) {
      Scope inner = scope;
      inner.file = beside(scope.file, file);
      read_file(inner.file, inner, given, where);
    }
  }

  void read_container(YamlMap& map, const Scope& scope) {
    ContainerDescription container;
    container.where = map.where();
    container.name = read_name(map, "name the process", findings_);
    container.name_space = read_name_space(map, scope, findings_);
    map.text("pkg");  // ignored: there is only one kind of container
    map.text("exec");
    read_policies(map, scope, findings_, container);
    const OnError on_error = read_on_error(map, OnError::kRestart, findings_);
    container.respawn = map.flag("respawn", false);
    container.respawn_delay_s =
        read_number(map, "respawn_delay", fmt::format("seconds, 0 to {}", kMaxDelayS), kMaxDelayS);
    container.shared_images_mb =
        read_number(map, "shared_images_mb", fmt::format("megabytes, 0 (off) to {}", kMaxImageMb), kMaxImageMb)
            .value_or(kMaxImageMb);
    container.max_message_mb =
        read_number(map, "max_message_mb", fmt::format("megabytes, 0 to {}", kMaxMessageMb), kMaxMessageMb)
            .value_or(container.max_message_mb);
    container.max_topic_rate_hz =
        read_number(map, "max_topic_rate_hz", fmt::format("messages per second, 0 to {}", kMaxRateHz), kMaxRateHz)
            .value_or(container.max_topic_rate_hz);
    if (!map.has("composable_node")) {
      findings_.problems.add(map.where(),
                             "node_container " + container.name + " loads nothing; add a list composable_node");
    }
    for (const auto& node : map.list("composable_node")) {
      YamlMap component(node, "composable_node", scope, findings_);
      if (component.applies()) {
        container.components.push_back(read_component(component, scope, on_error, findings_));
        const auto& added = container.components.back();
        claim_name(full_name(added.name_space, added.name), "component", added.where);
      }
    }
    read_own_parameters(map, scope, container);
    map.finish(kContainerKeysWithoutEffect);
    claim_name(full_name(container.name_space, container.name), "container", container.where);
    system_.containers.push_back(std::move(container));
  }

  void read_own_parameters(YamlMap& map, const Scope& scope, ContainerDescription& container) {
    container.parameters = read_parameters(map, full_name(container.name_space, container.name), scope, findings_);
    for (const auto& [name, value] : NodeParameters::others(container.parameters)) {
      findings_.note(value.where, "parameter " + name + " of node_container has no effect here");
      container.parameters.erase(name);
    }
  }

  std::optional<double> read_number(YamlMap& map, const std::string& key, const std::string& what, double largest) {
    return runtime::read_number(map, key, what, largest, findings_);
  }

  void claim_name(const std::string& name, const std::string& what, const Location& where) {
    const auto [first, is_new] = taken_names_.emplace(name, where);
    if (!is_new && !name.ends_with('/')) {
      findings_.problems.add(where, what + " " + name + " has the same name as the one at " +
                                        first->second.to_string() + "; give it another name or namespace");
    }
  }

  SystemDescription system_;
  Findings findings_;
  std::vector<std::filesystem::path> open_files_;
  std::map<std::string, Location> taken_names_;
};

}  // namespace

SystemDescription read_system_file(const std::filesystem::path& file,
                                   const std::map<std::string, std::string>& arguments) {
  return SystemReader().read(file.lexically_normal(), arguments);
}

}  // namespace panvo::runtime

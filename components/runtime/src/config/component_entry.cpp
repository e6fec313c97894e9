// SPDX-License-Identifier: Apache-2.0
#include "component_entry.hpp"

#include <algorithm>

#include "panvo/runtime/names.hpp"
#include "parameter_file.hpp"
#include "policies_entry.hpp"

namespace panvo::runtime {
namespace {

/// The list `param` of a component. Entries override values from files; two entries with the same name are an error.
class ParameterEntries {
 public:
  ParameterEntries(std::string node, const Scope& scope, Findings& findings, WrittenValues& parameters)
      : node_(std::move(node)), scope_(scope), findings_(findings), parameters_(parameters) {}

  void read(const YAML::Node& entry, const std::string& prefix = "") {
    YamlMap map(entry, "param", scope_, findings_);
    if (!map.is_map()) {
      return;
    }
    if (prefix.empty() && map.has("from")) {
      read_file(map);
    } else {
      const auto name = prefix + map.required("name", "write {name: NAME, value: VALUE} or {from: FILE}");
      if (map.has("param")) {
        for (const auto& nested : map.list("param")) {
          read(nested, name + ".");
        }
      } else {
        read_value(map, name);
      }
    }
    map.finish();
  }

 private:
  void read_file(YamlMap& map) {
    const auto file = map.required("from", "name a parameter file");
    const bool substitutes = map.flag("allow_substs", false);
    if (file.empty()) {
      return;
    }
    auto values = read_parameter_file(beside(scope_.file, file), node_, substitutes ? &scope_ : nullptr,
                                      map.where("from"), findings_);
    for (auto& [name, value] : values) {
      parameters_[name] = std::move(value);
    }
  }

  void read_value(YamlMap& map, const std::string& name) {
    const auto value = map.node("value");
    if (!value) {
      findings_.problems.add(map.where(), "param " + name + " lacks the key \"value\"");
      return;
    }
    if (std::find(entered_.begin(), entered_.end(), name) != entered_.end()) {
      findings_.problems.add(map.where("name"), "parameter " + name + " is given twice, first at " +
                                                    parameters_[name].where.to_string() + "; keep one");
      return;
    }
    if (auto written = written_value(*value, name, map.where("name"), &scope_, findings_)) {
      parameters_[name] = std::move(*written);
      entered_.push_back(name);
    }
  }

  std::string node_;
  const Scope& scope_;
  Findings& findings_;
  WrittenValues& parameters_;
  std::vector<std::string> entered_;
};

}  // namespace

std::string read_topic(YamlMap& map, const std::string& key, Findings& findings) {
  auto topic = map.required(key, "write {from: TOPIC, to: TOPIC}");
  if (const auto wrong = topic_name_problem(topic); wrong && !topic.empty()) {
    findings.problems.add(map.where(key), "topic name \"" + topic + "\" " + *wrong);
  }
  return topic;
}

ComponentDescription read_component(YamlMap& map, const Scope& scope, OnError on_error, Findings& findings) {
  ComponentDescription component;
  component.where = map.where();
  component.package = map.required("pkg", "name the package that has the plugin");
  if (const auto wrong = package_name_problem(component.package); wrong && !component.package.empty()) {
    findings.problems.add(map.where("pkg"), "pkg \"" + component.package + "\" " + *wrong);
  }
  component.plugin = map.required("plugin", "name the component's class");
  if (const auto wrong = class_name_problem(component.plugin); wrong && !component.plugin.empty()) {
    findings.problems.add(map.where("plugin"), "plugin \"" + component.plugin + "\" " + *wrong);
  }
  component.name = read_name(map, "name the component", findings);
  component.name_space = read_name_space(map, scope, findings);
  component.on_error = read_on_error(map, on_error, findings);

  component.parameters = read_parameters(map, full_name(component.name_space, component.name), scope, findings);
  for (const auto& entry : map.list("remap")) {
    YamlMap remap(entry, "remap", scope, findings);
    if (!remap.is_map()) {
      continue;
    }
    const auto from = read_topic(remap, "from", findings);
    const auto to = read_topic(remap, "to", findings);
    if (is_remapped(component.name_space, component.name, component.remaps, from)) {
      findings.problems.add(remap.where(), "topic " + from + " is remapped twice; keep one");
    }
    component.remaps.emplace(from, to);
    remap.finish();
  }
  // Those of the component prevail; of the others, the last.
  for (auto rule = scope.remaps.rbegin(); rule != scope.remaps.rend(); ++rule) {
    if (!is_remapped(component.name_space, component.name, component.remaps, rule->first))
      component.remaps.insert(*rule);
  }
  map.finish({"extra_arg"});
  return component;
}

WrittenValues read_parameters(YamlMap& map, const std::string& node, const Scope& scope, Findings& findings) {
  WrittenValues read;
  ParameterEntries parameters(node, scope, findings, read);
  for (const auto& entry : map.list("param")) {
    parameters.read(entry);
  }
  return read;
}

std::string read_name(YamlMap& map, const std::string& remedy, Findings& findings) {
  auto name = map.required("name", remedy);
  if (const auto wrong = node_name_problem(name); wrong && !name.empty()) {
    findings.problems.add(map.where("name"), "name \"" + name + "\" " + *wrong);
  }
  return name;
}

std::string read_name_space(YamlMap& map, const Scope& scope, Findings& findings) {
  const auto name_space = map.text("namespace").value_or("");
  if (const auto wrong = name_space_problem(name_space)) {
    findings.problems.add(map.where("namespace"), "namespace \"" + name_space + "\" " + *wrong);
  }
  return join_name_spaces(scope.name_space, name_space);
}

}  // namespace panvo::runtime

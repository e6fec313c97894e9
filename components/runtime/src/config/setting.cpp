// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/names.hpp"
#include "panvo/runtime/system_file.hpp"
#include "yaml.hpp"

namespace panvo::runtime {
namespace {

const Location kSettingLocation{"--set", 0};

[[noreturn]] void refuse_setting(const std::string& setting, const std::string& why) {
  throw ConfigError(kSettingLocation.file + " " + setting + ": " + why);
}

WrittenValue value_from(const std::string& text, const std::string& setting) {
  if (!text.starts_with('[')) {
    return {.items = {text}, .is_list = false, .where = kSettingLocation};
  }
  YAML::Node list;
  try {
    list = YAML::Load(text);
  } catch (const YAML::Exception&) {
    refuse_setting(setting, "the list is not closed; write [1, 2]");
  }
  Findings findings;
  auto value = written_value(list, "of the list", kSettingLocation, nullptr, findings);
  if (!value) {
    refuse_setting(setting, "list items must be single values; write [1, 2]");
  }
  return std::move(*value);
}

}  // namespace

void apply_setting(SystemDescription& system, const std::string& setting) {
  const auto equals = setting.find('=');
  const auto dot = setting.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals) {
    refuse_setting(setting, "write COMPONENT.PARAMETER=VALUE");
  }
  const std::string component_name = setting.substr(0, dot);
  const std::string parameter = setting.substr(dot + 1, equals - dot - 1);
  const WrittenValue value = value_from(setting.substr(equals + 1), setting);

  std::vector<std::string> known;
  bool found = false;
  for (auto& container : system.containers) {
    for (auto& component : container.components) {
      if (component.name == component_name || full_name(component.name_space, component.name) == component_name) {
        component.parameters[parameter] = value;
        found = true;
      }
      known.push_back(component.name);
    }
  }
  if (!found) {
    std::string names;
    for (const auto& name : known) {
      names += (names.empty() ? "" : ", ") + name;
    }
    refuse_setting(setting, "unknown component \"" + component_name + "\"; " + system.file + " has " +
                                (names.empty() ? "none" : names));
  }
}

}  // namespace panvo::runtime

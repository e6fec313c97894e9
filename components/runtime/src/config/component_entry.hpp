// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/runtime/system_file.hpp"
#include "yaml.hpp"

namespace panvo::runtime {

/// Reads the body of a `composable_node`; `on_error` is the container's setting.
ComponentDescription read_component(YamlMap& map, const Scope& scope, OnError on_error, Findings& findings);

/// Reads the list `param` of the node with this full name.
WrittenValues read_parameters(YamlMap& map, const std::string& node, const Scope& scope, Findings& findings);

/// Reads and checks the `name` of a node or container.
std::string read_name(YamlMap& map, const std::string& remedy, Findings& findings);

/// Reads and checks the topic name at a key of a remap.
std::string read_topic(YamlMap& map, const std::string& key, Findings& findings);

/// Absolute namespace of an entry: its `namespace` within the namespace of the scope.
std::string read_name_space(YamlMap& map, const Scope& scope, Findings& findings);

}  // namespace panvo::runtime

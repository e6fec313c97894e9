// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/runtime/system_file.hpp"
#include "yaml.hpp"

namespace panvo::runtime {

/// Reads the body of a `composable_node`; `on_error` is its container's.
ComponentDescription read_component(YamlMap& map, const Scope& scope, OnError on_error, Findings& findings);

/// The checked `name` of a node or container.
std::string read_name(YamlMap& map, const std::string& remedy, Findings& findings);

/// The absolute namespace of an entry: its `namespace` as seen from the scope's.
std::string read_name_space(YamlMap& map, const Scope& scope, Findings& findings);

}  // namespace panvo::runtime

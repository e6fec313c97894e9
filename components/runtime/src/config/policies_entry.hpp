// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/runtime/system_file.hpp"
#include "yaml.hpp"

namespace panvo::runtime {

/// `on_error` of a container or component.
OnError read_on_error(YamlMap& map, OnError otherwise, Findings& findings);

/// Reads a container's policies: `services`, `files_below`, `requests_per_s`, `required`.
void read_policies(YamlMap& map, const Scope& scope, Findings& findings, ContainerDescription& container);

/// Reads a number from 0 to `largest`; nullopt if missing or invalid. `what` describes valid values: "seconds, 0 to
/// 10".
std::optional<double> read_number(YamlMap& map, const std::string& key, const std::string& what, double largest,
                                  Findings& findings);

}  // namespace panvo::runtime

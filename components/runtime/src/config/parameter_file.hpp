// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "yaml.hpp"

namespace panvo::runtime {

/// Whether a section of a ROS 2 parameter file applies to a node: "/**" matches all, "*" one word, "**" any number of
/// words; a name without a namespace matches each node of that name. `node` is a full name.
bool section_is_for(std::string_view pattern, std::string_view node);

/// Reads the parameters of `node` (full name) from a ROS 2 parameter file: sections in file order, later ones override
/// earlier ones, nested maps become dotted names. Values of a section with "*" are for several nodes. Adds a note if no
/// section applies. Substitutes if `scope` is given.
WrittenValues read_parameter_file(const std::filesystem::path& file, const std::string& node, const Scope* scope,
                                  const Location& named_at, Findings& findings);

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "yaml.hpp"

namespace panvo::runtime {

/// Whether a section of a ROS 2 parameter file is for a node: "/**" is for all, "*" stands for one word, "**"
/// for any number, and a name without a namespace for each node of that name. `node` is a full name.
bool section_is_for(std::string_view pattern, std::string_view node);

/// Reads from a ROS 2 parameter file what it says to `node` (full name): sections in the order of the file,
/// the later overriding the earlier, nested maps as dotted names. Notes when nothing in it is for that node.
/// Substitutes if there is a scope.
WrittenValues read_parameter_file(const std::filesystem::path& file, const std::string& node, const Scope* scope,
                                  const Location& named_at, Findings& findings);

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace panvo::runtime {

/// What is wrong with a path that another process names, where only those below `folder` are allowed (empty: none); nullopt: nothing, or it names
/// no file. Links and ".." are followed first, as far as the path is there.
std::optional<std::string> path_problem(const std::string& path, const std::filesystem::path& folder);

}  // namespace panvo::runtime

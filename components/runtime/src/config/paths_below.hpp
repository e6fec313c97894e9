// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace panvo::runtime {

/// Returns what is wrong with a path given by another process, if only paths below `folder` are allowed (empty: none).
/// nullopt if it is allowed or empty. Links and ".." are resolved first, as far as the path exists.
std::optional<std::string> path_problem(const std::string& path, const std::filesystem::path& folder);

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace panvo::interfaces {

/// Folders in a colon-separated environment variable; none if it is not set.
std::vector<std::filesystem::path> folders_in(const char* variable);

/// Library folders of installed packages, in search order: those of each prefix in COLCON_PREFIX_PATH (and of the
/// package prefixes below it), AMENT_PREFIX_PATH and CMAKE_PREFIX_PATH, then of the running program's prefix. Some may
/// not exist.
std::vector<std::filesystem::path> library_folders();

/// Search path for message libraries: PANVO_PLUGIN_PATH, library_folders(), the plugin folder next to a program in a
/// build tree, then the folder of this library and the plugin folder next to it.
std::vector<std::filesystem::path> message_folders();

/// File name of a package's message library: "libmy_msgs__panvo.so".
std::string message_library_name(std::string_view package);

}  // namespace panvo::interfaces

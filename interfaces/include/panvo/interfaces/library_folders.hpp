// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace panvo::interfaces {

/// The folders that an environment variable lists, separated by colons.
std::vector<std::filesystem::path> folders_in(const char* variable);

/// Where libraries of installed packages lie: the library folders of each prefix in COLCON_PREFIX_PATH (its packages' own ones too),
/// AMENT_PREFIX_PATH and CMAKE_PREFIX_PATH, then of the prefix of the running program. Not all of them need to exist.
std::vector<std::filesystem::path> library_folders();

/// Where libraries of messages are looked for: PANVO_PLUGIN_PATH, library_folders(), and the plugins' folder beside a program that was built and not
/// installed.
std::vector<std::filesystem::path> message_folders();

/// The name of the file that holds the messages of a package: "libmy_msgs__panvo.so".
std::string message_library_name(std::string_view package);

}  // namespace panvo::interfaces

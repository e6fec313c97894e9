// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/library_folders.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>

namespace panvo::interfaces {
namespace fs = std::filesystem;

namespace {

/// CMAKE_INSTALL_LIBDIR is lib/x86_64-linux-gnu or the like below Debian's /usr, lib or lib64 elsewhere.
void add_prefix(const fs::path& prefix, std::vector<fs::path>& folders) {
  for (const std::string libraries : {PANVO_INSTALL_LIBDIR, "lib/" PANVO_ARCHITECTURE, "lib"}) {
    const fs::path folder = prefix / libraries;
    if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
  }
}

/// colcon's default layout: one prefix per package below a common one.
void add_isolated_prefixes(const fs::path& common, std::vector<fs::path>& folders) {
  std::set<fs::path> prefixes;
  std::error_code error;
  for (const auto& package : fs::directory_iterator(common, error)) prefixes.insert(package.path());
  for (const auto& prefix : prefixes) {
    std::vector<fs::path> of_package;
    add_prefix(prefix, of_package);
    std::ranges::copy_if(of_package, std::back_inserter(folders),
                         [&error](const fs::path& folder) { return fs::is_directory(folder, error); });
  }
}

/// Empty without /proc.
fs::path program_folder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

/// Of this library; empty if unknown.
fs::path own_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&message_library_name), &info) == 0 || info.dli_fname == nullptr) return {};
  return fs::path(info.dli_fname).parent_path();
}

}  // namespace

std::vector<fs::path> folders_in(const char* variable) {
  const char* value = std::getenv(variable);
  std::istringstream list(value ? value : "");
  std::vector<fs::path> folders;
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

std::vector<fs::path> library_folders() {
  std::vector<fs::path> folders;
  for (const auto& prefix : folders_in("COLCON_PREFIX_PATH")) {
    add_prefix(prefix, folders);
    add_isolated_prefixes(prefix, folders);
  }
  for (const char* variable : {"AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"}) {
    for (const auto& prefix : folders_in(variable)) add_prefix(prefix, folders);
  }
  if (const auto folder = program_folder(); !folder.empty()) add_prefix(folder / "..", folders);
  return folders;
}

std::vector<fs::path> message_folders() {
  std::vector<fs::path> folders = folders_in("PANVO_PLUGIN_PATH");
  std::ranges::copy(library_folders(), std::back_inserter(folders));
  if (const auto folder = program_folder(); !folder.empty()) folders.push_back(folder / ".." / "panvo_plugins");
  // For programs that are not panvo's own, such as the Python interpreter.
  if (const auto folder = own_folder(); !folder.empty()) {
    folders.push_back(folder);
    folders.push_back(folder / ".." / "panvo_plugins");
  }
  return folders;
}

std::string message_library_name(std::string_view package) { return "lib" + std::string(package) + "__panvo.so"; }

}  // namespace panvo::interfaces

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "panvo/runtime/component.hpp"

namespace panvo::runtime {

/// A loaded plugin. Unmapped when its last owner is gone: the container, its components, and all messages created by
/// its code.
class Library {
 public:
  /// Throws ConfigError with the file and the problem.
  explicit Library(const std::filesystem::path& file);
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  const std::filesystem::path& file() const noexcept { return file_; }
  /// Finds a component by class name, with or without namespace ("panvo::StereoRectifierComponent"); nullptr if there
  /// is none.
  const ComponentDescriptor* find(const std::string& class_name) const;
  std::vector<const ComponentDescriptor*> components() const;

 private:
  std::filesystem::path file_;
  void* handle_;
  const ComponentDescriptor* first_;
};

/// Finds the plugin file of a package: panvo_stereo_rectifier -> libpanvo_stereo_rectifier_component.so. Searches the
/// folders of $PANVO_PLUGIN_PATH, lib/panvo and lib/<architecture>/panvo in the prefixes of $COLCON_PREFIX_PATH,
/// $AMENT_PREFIX_PATH and $CMAKE_PREFIX_PATH, and next to the executable. Throws ConfigError with the searched folders.
std::filesystem::path find_plugin(const std::string& package);

/// The folders searched by find_plugin.
std::vector<std::filesystem::path> plugin_folders();

}  // namespace panvo::runtime

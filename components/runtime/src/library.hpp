// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "panvo/runtime/component.hpp"

namespace panvo::runtime {

/// A loaded plugin. It is unmapped when the last owner lets go: the container, its component, and every message that its code made.
class Library {
 public:
  /// Throws ConfigError that names the file and what is wrong with it.
  explicit Library(const std::filesystem::path& file);
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  const std::filesystem::path& file() const noexcept { return file_; }
  /// The component of that class name, with or without its namespace ("panvo::StereoRectifierComponent"); nullptr if there is none.
  const ComponentDescriptor* find(const std::string& class_name) const;
  std::vector<const ComponentDescriptor*> components() const;

 private:
  std::filesystem::path file_;
  void* handle_;
  const ComponentDescriptor* first_;
};

/// Finds the plugin file of a package: panvo_stereo_rectifier -> libpanvo_stereo_rectifier_component.so, in the folders of $PANVO_PLUGIN_PATH, in lib/panvo and
/// lib/<architecture>/panvo of the prefixes of $COLCON_PREFIX_PATH, $AMENT_PREFIX_PATH and $CMAKE_PREFIX_PATH, and beside the executable. Throws ConfigError that lists where it looked.
std::filesystem::path find_plugin(const std::string& package);

/// The folders find_plugin looks in.
std::vector<std::filesystem::path> plugin_folders();

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace panvo::calibration {

/// Reads and validates values of a YAML map. All functions throw CalibrationError with file, line and key.
class YamlDocument {
 public:
  /// `kind`: the expected kind of file for messages, e.g. "a camera_info file".
  YamlDocument(const std::filesystem::path& path, const std::string& kind);
  YamlDocument(std::filesystem::path path, YAML::Node map) : path_(std::move(path)), map_(std::move(map)) {}

  bool has(const char* key) const { return map_[key].IsDefined(); }
  std::string text(const char* key) const;
  int integer(const char* key, int low, int high) const;
  /// Reads a list, nested lists, or a map with a list `data`. `count`: required number of values (0: any); all finite.
  std::vector<double> numbers(const char* key, std::size_t count) const;
  YAML::Node at(const char* key) const;

  [[noreturn]] void fail(const char* key, const std::string& what) const;

  const YAML::Node& map() const { return map_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  YAML::Node map_;
};

}  // namespace panvo::calibration

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace panvo::calibration {

/// A map of a YAML file, whose values are read or refused with file, line and key. Every function throws CalibrationError.
class YamlDocument {
 public:
  /// `kind`: what is expected, "a camera_info file".
  YamlDocument(const std::filesystem::path& path, const std::string& kind);
  YamlDocument(std::filesystem::path path, YAML::Node map) : path_(std::move(path)), map_(std::move(map)) {}

  bool has(const char* key) const { return map_[key].IsDefined(); }
  std::string text(const char* key) const;
  int integer(const char* key, int low, int high) const;
  /// A list, a list of lists, or a matrix with `data`; so many numbers (0: any count), all finite.
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

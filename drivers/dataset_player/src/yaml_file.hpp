// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "panvo/dataset_player/dataset.hpp"

namespace panvo::dataset_player {

/// A YAML file of calibration values, plain or in OpenCV's form (%YAML:1.0, !!opencv-matrix). Errors throw DatasetError
/// with file, line and key.
class YamlFile {
 public:
  explicit YamlFile(std::filesystem::path path);

  const std::filesystem::path& path() const noexcept { return path_; }

  bool has(const std::string& key) const { return static_cast<bool>(root_[key]); }
  /// The first of `keys` that exists; used for keys whose names differ between tools.
  std::optional<std::string> first_of(std::initializer_list<const char*> keys) const;

  int integer(const std::string& key) const;
  std::string text(const std::string& key, const std::string& when_absent) const;
  /// All numbers of a value: a list, nested lists, or a matrix (a map with `data`). `count`: required number.
  std::vector<double> numbers(const std::string& key) const;
  std::vector<double> numbers(const std::string& key, std::size_t count) const;

  [[noreturn]] void fail(const std::string& key, std::string_view what) const;

 private:
  YAML::Node at(const std::string& key) const;

  std::filesystem::path path_;
  YAML::Node root_;
};

}  // namespace panvo::dataset_player

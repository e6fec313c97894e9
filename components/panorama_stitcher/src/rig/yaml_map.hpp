// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace panvo::panorama_stitcher {

/// Loads a YAML file. Throws RigFileError if it cannot be read or is not a map.
YAML::Node load_yaml(const std::filesystem::path& file);

/// Reads the values of a YAML map; collects problems and the requested keys. Missing or invalid values give the
/// argument `instead`.
class YamlMap {
 public:
  YamlMap(std::filesystem::path file, YAML::Node node, std::vector<std::string>& problems);

  bool has(const char* key);
  double number(const char* key, double instead, double low, double high);
  int integer(const char* key, int instead, int low, int high);
  std::string text(const char* key, const std::string& instead);
  /// Reads a list, or the list `data` of a map. `count`: required number of values (0: any). Empty if missing or
  /// invalid.
  std::vector<double> numbers(const char* key, std::size_t count);
  void require(const char* key);

  /// "rig.yaml:17: blend_deg"; with the line of the map if the key is missing.
  std::string where(const char* key) const;
  void reject(const char* key, const std::string& what);
  /// Reports unknown keys, i.e. those that were not requested.
  void finish();

  const std::filesystem::path& file() const { return file_; }
  std::vector<std::string>& problems() { return problems_; }

 private:
  YAML::Node find(const char* key);

  std::filesystem::path file_;
  YAML::Node node_;
  std::set<std::string> asked_;
  std::vector<std::string>& problems_;
};

}  // namespace panvo::panorama_stitcher

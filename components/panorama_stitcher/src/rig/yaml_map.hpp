// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace panvo::panorama_stitcher {

/// What a YAML file holds; throws RigFileError when it cannot be read or holds no keys.
YAML::Node load_yaml(const std::filesystem::path& file);

/// A map of a YAML file: reads its values, and notes what is wrong and which keys were asked for. A value that is missing or wrong reads as
/// the one given instead.
class YamlMap {
 public:
  YamlMap(std::filesystem::path file, YAML::Node node, std::vector<std::string>& problems);

  bool has(const char* key);
  double number(const char* key, double instead, double low, double high);
  int integer(const char* key, int instead, int low, int high);
  std::string text(const char* key, const std::string& instead);
  /// A list of so many numbers (0: any count), or a matrix with `data`; empty when missing or wrong.
  std::vector<double> numbers(const char* key, std::size_t count);
  void require(const char* key);

  /// "rig.yaml:17: blend_deg"; the map's own line where the key is not there.
  std::string where(const char* key) const;
  void reject(const char* key, const std::string& what);
  /// Notes keys that nobody asked for.
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

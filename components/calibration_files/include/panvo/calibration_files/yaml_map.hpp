// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "panvo/calibration_files/file_error.hpp"

namespace panvo::calibration_files {

/// Range of a number, with its unit for messages. The default excludes only numbers that no calibration contains.
struct Range {
  double min = -1e8;
  double max = 1e8;
  const char* unit = "";
};

/// Reads the values of a YAML map and collects the problems; check() and finish() throw all of them as one FileError.
/// Until then a missing or wrong value is read as `instead`, or as zero. Without `instead` the key is required.
/// Messages name a key with the maps around it: "panorama.blend_deg", "heads[1].camera_info".
class YamlMap {
 public:
  /// Loads a file of plain YAML or of OpenCV (%YAML:1.0, !!opencv-matrix). `kind`: the expected kind of file, for
  /// messages: "a ROS camera_info file". Throws FileError if the file cannot be read or is not a map.
  YamlMap(const std::filesystem::path& file, const std::string& kind);

  const std::filesystem::path& file() const;
  bool has(const std::string& key);

  double number(const std::string& key, const Range& range, std::optional<double> instead = {});
  int integer(const std::string& key, int min, int max, std::optional<int> instead = {});
  bool flag(const std::string& key, std::optional<bool> instead = {});
  /// A non-empty text; an empty one counts as missing.
  std::string text(const std::string& key, const std::optional<std::string>& instead = {});
  /// One of several words.
  std::string choice(const std::string& key, const std::vector<std::string>& words,
                     const std::optional<std::string>& instead = {});
  /// The required numbers of a list, of a list of rows, or of a matrix (a map with a list `data`). Has `count` numbers
  /// also if they are wrong; without `count` any number of them is valid.
  std::vector<double> numbers(const std::string& key, std::optional<std::size_t> count = {}, const Range& range = {});
  /// A required image size: [width, height], whole numbers of px.
  std::array<int, 2> size_px(const std::string& key, int min = 1, int max = 1 << 16);

  /// A map inside this one, with the same problems; without keys if it is missing. To be taken once.
  YamlMap map(const std::string& key);
  /// A required list of at least one map, likewise.
  std::vector<YamlMap> maps(const std::string& key);

  /// Location of a key for messages: "rig.yaml:17: panorama.blend_deg". The line is that of the map if it lacks the key.
  std::string where(const std::string& key) const;
  /// Adds a problem of a key; `what` follows its name: "must be ...".
  void reject(const std::string& key, const std::string& what);
  /// Adds the problems of another file, which the value of `key` names; only once if several keys name it.
  void include(const std::string& key, const FileError& error);

  /// Number of problems so far; tells whether a value that was just read is valid.
  std::size_t problems() const;
  /// Throws the problems so far. For files that may contain other keys.
  void check() const;
  /// Throws the problems, including the keys nobody asked for, in this map and in the maps taken from it.
  void finish();

 private:
  struct Document;
  struct Part;

  YamlMap(std::shared_ptr<Document> document, std::shared_ptr<Part> part);
  /// `rule` follows "must be" if decode(node, value) returns false.
  template <class Value, class Decode>
  Value read(const std::string& key, const std::optional<Value>& instead, const std::string& rule, Decode decode);

  std::shared_ptr<Document> document_;  // shared by all maps of a file
  std::shared_ptr<Part> part_;
};

}  // namespace panvo::calibration_files

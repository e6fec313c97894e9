// SPDX-License-Identifier: Apache-2.0
#include "yaml_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "panvo/panorama_stitcher/rig_file.hpp"

namespace panvo::panorama_stitcher {

YAML::Node load_yaml(const std::filesystem::path& file) {
  YAML::Node root;
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::BadFile&) {
    throw RigFileError(file.string() + ": cannot be opened; check that it exists and is readable");
  } catch (const YAML::Exception& error) {
    throw RigFileError(fmt::format("{}:{}: is not YAML: {}", file.string(), error.mark.line + 1, error.msg));
  }
  if (!root.IsMap())
    throw RigFileError(file.string() + ": contains no `key: value` lines; check that it is the right file");
  return root;
}

YamlMap::YamlMap(std::filesystem::path file, YAML::Node node, std::vector<std::string>& problems)
    : file_(std::move(file)), node_(std::move(node)), problems_(problems) {
  if (node_ && node_.IsMap()) return;
  problems_.push_back(
      fmt::format("{}:{}: must be a map of `key: value` lines", file_.string(), node_ ? node_.Mark().line + 1 : 1));
  node_.reset(YAML::Node(YAML::NodeType::Map));  // an assignment would change the document
}

YAML::Node YamlMap::find(const char* key) {
  asked_.insert(key);
  return std::as_const(node_)[key];
}

bool YamlMap::has(const char* key) { return find(key).IsDefined(); }

double YamlMap::number(const char* key, double instead, double low, double high) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return instead;
  double value = 0.0;
  if (YAML::convert<double>::decode(node, value) && value >= low && value <= high) return value;
  reject(key, fmt::format("must be a number from {} to {}", low, high));
  return instead;
}

int YamlMap::integer(const char* key, int instead, int low, int high) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return instead;
  int value = 0;
  if (YAML::convert<int>::decode(node, value) && value >= low && value <= high) return value;
  reject(key, fmt::format("must be a whole number from {} to {}", low, high));
  return instead;
}

std::string YamlMap::text(const char* key, const std::string& instead) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return instead;
  if (node.IsScalar() && !node.Scalar().empty()) return node.Scalar();
  reject(key, "must be a non-empty string");
  return instead;
}

std::vector<double> YamlMap::numbers(const char* key, std::size_t count) {
  const YAML::Node node = find(key);
  if (!node.IsDefined()) return {};
  const YAML::Node list = node.IsMap() ? node["data"] : node;
  std::vector<double> values;
  const bool is_list = list.IsDefined() && YAML::convert<std::vector<double>>::decode(list, values) &&
                       std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (is_list && (count == 0 || values.size() == count)) return values;
  reject(key,
         count == 0 ? std::string("must be a list of numbers") : fmt::format("must be a list of {} numbers", count));
  return {};
}

void YamlMap::require(const char* key) {
  if (!has(key)) reject(key, "is missing; add it");
}

std::string YamlMap::where(const char* key) const {
  int line = node_.Mark().line;
  for (const auto& item : node_) {
    if (item.first.Scalar() == key) line = item.first.Mark().line;
  }
  return fmt::format("{}:{}: {}", file_.string(), std::max(line, 0) + 1, key);
}

void YamlMap::reject(const char* key, const std::string& what) { problems_.push_back(where(key) + " " + what); }

void YamlMap::finish() {
  for (const auto& item : node_) {
    const auto& key = item.first.Scalar();
    if (!asked_.contains(key))
      reject(key.c_str(), fmt::format("is not a known key; known keys: {}", fmt::join(asked_, ", ")));
  }
}

}  // namespace panvo::panorama_stitcher

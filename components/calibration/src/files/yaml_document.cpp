// SPDX-License-Identifier: Apache-2.0
#include "yaml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "panvo/calibration/calibration_error.hpp"

namespace panvo::calibration {
namespace {

bool read(const YAML::Node& node, std::vector<double>& values) {
  if (node.IsScalar()) {
    double value = 0.0;
    if (!YAML::convert<double>::decode(node, value) || !std::isfinite(value)) return false;
    values.push_back(value);
    return true;
  }
  return node.IsSequence() &&
         std::all_of(node.begin(), node.end(), [&](const YAML::Node& item) { return read(item, values); });
}

}  // namespace

YamlDocument::YamlDocument(const std::filesystem::path& path, const std::string& kind) : path_(path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw CalibrationError(path.string() + ": is a folder; expected " + kind);
  try {
    map_ = YAML::LoadFile(path.string());
  } catch (const YAML::BadFile&) {
    throw CalibrationError(path.string() + ": cannot be opened; check that it exists and is readable");
  } catch (const YAML::Exception& problem) {
    throw CalibrationError(
        fmt::format("{}:{}: is not YAML: {}; expected {}", path.string(), problem.mark.line + 1, problem.msg, kind));
  }
  if (!map_.IsMap())
    throw CalibrationError(fmt::format("{}: contains no `key: value` lines; expected {}", path.string(), kind));
}

YAML::Node YamlDocument::at(const char* key) const {
  if (!has(key))
    throw CalibrationError(fmt::format("{}:{}: {} is missing; add it", path_.string(), map_.Mark().line + 1, key));
  return map_[key];
}

void YamlDocument::fail(const char* key, const std::string& what) const {
  int line = map_.Mark().line;
  for (const auto& item : map_) {
    if (item.first.Scalar() == key) line = item.first.Mark().line;
  }
  throw CalibrationError(fmt::format("{}:{}: {} {}", path_.string(), line + 1, key, what));
}

std::string YamlDocument::text(const char* key) const {
  const auto node = at(key);
  if (!node.IsScalar() || node.Scalar().empty()) fail(key, "must be a non-empty string");
  return node.Scalar();
}

int YamlDocument::integer(const char* key, int low, int high) const {
  int value = 0;
  const auto node = at(key);
  if (!YAML::convert<int>::decode(node, value) || value < low || value > high)
    fail(key, fmt::format("must be a whole number from {} to {}{}", low, high,
                          node.IsScalar() ? fmt::format(", not '{}'", node.Scalar()) : ""));
  return value;
}

std::vector<double> YamlDocument::numbers(const char* key, std::size_t count) const {
  const auto node = at(key);
  const YAML::Node list = node.IsMap() ? node["data"] : node;
  std::vector<double> values;
  const bool is_list = list.IsDefined() && list.IsSequence() && read(list, values);
  if (is_list && (count == 0 || values.size() == count)) return values;
  if (count == 0) fail(key, "must be a list of numbers");
  fail(key, fmt::format("must be {} numbers{}", count, is_list ? fmt::format(", not {}", values.size()) : ""));
}

}  // namespace panvo::calibration

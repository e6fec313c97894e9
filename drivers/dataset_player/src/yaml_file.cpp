// SPDX-License-Identifier: Apache-2.0
#include "yaml_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "panvo/interfaces/check.hpp"

namespace panvo::dataset_player {
namespace {

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw DatasetError(path.string() + ": cannot be opened; check that it exists and is readable");
  std::ostringstream text;
  text << file.rdbuf();
  std::string content = text.str();
  // OpenCV's directive is not valid YAML 1.x; turning it into a comment keeps the line numbers.
  if (content.starts_with("%YAML:")) content[0] = '#';
  return content;
}

bool append_numbers(const YAML::Node& node, std::vector<double>& numbers) {
  if (node.IsMap()) return node["data"] && append_numbers(node["data"], numbers);
  if (node.IsSequence()) {
    for (const auto& item : node) {
      if (!append_numbers(item, numbers)) return false;
    }
    return true;
  }
  double value = 0.0;
  if (!YAML::convert<double>::decode(node, value)) return false;
  numbers.push_back(value);
  return true;
}

}  // namespace

YamlFile::YamlFile(std::filesystem::path path) : path_(std::move(path)) {
  try {
    root_ = YAML::Load(read_text(path_));
  } catch (const YAML::ParserException& error) {
    throw DatasetError(path_.string() + ":" + std::to_string(error.mark.line + 1) + ": is not YAML: " + error.msg);
  }
  if (!root_.IsMap())
    throw DatasetError(path_.string() + ": contains no `key: value` lines; check that it is the right file");
}

std::optional<std::string> YamlFile::first_of(std::initializer_list<const char*> keys) const {
  for (const char* key : keys) {
    if (has(key)) return key;
  }
  return std::nullopt;
}

int YamlFile::integer(const std::string& key) const {
  int value = 0;
  if (!YAML::convert<int>::decode(at(key), value)) fail(key, "must be a whole number");
  return value;
}

std::string YamlFile::text(const std::string& key, const std::string& when_absent) const {
  return has(key) && root_[key].IsScalar() ? root_[key].Scalar() : when_absent;
}

std::vector<double> YamlFile::numbers(const std::string& key) const {
  std::vector<double> values;
  if (!append_numbers(at(key), values)) fail(key, "must be a list of numbers or a matrix (rows, cols, data)");
  for (const double value : values) {
    if (!(std::abs(value) <= interfaces::kMaxCoordinate_m)) {
      fail(key, "contains a number that is not finite or not plausible; correct it, or recalibrate");
    }
  }
  return values;
}

std::vector<double> YamlFile::numbers(const std::string& key, std::size_t count) const {
  auto values = numbers(key);
  if (values.size() != count) {
    fail(key, "has " + std::to_string(values.size()) + " numbers where " + std::to_string(count) + " are needed");
  }
  return values;
}

void YamlFile::fail(const std::string& key, std::string_view what) const {
  std::string line;
  for (const auto& item : root_) {
    if (item.first.Scalar() == key) line = fmt::format(":{}", item.first.Mark().line + 1);
  }
  throw DatasetError(path_.string() + line + ": " + key + " " + std::string(what));
}

YAML::Node YamlFile::at(const std::string& key) const {
  if (!has(key)) throw DatasetError(path_.string() + ": " + key + " is missing; add it");
  return root_[key];
}

}  // namespace panvo::dataset_player

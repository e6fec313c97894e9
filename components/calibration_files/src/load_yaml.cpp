// SPDX-License-Identifier: Apache-2.0
#include "load_yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "panvo/calibration_files/file_error.hpp"

namespace panvo::calibration_files {

YAML::Node load_yaml_map(const std::filesystem::path& file, const std::string& kind) {
  const auto expected = [&](const std::string& what) {
    return FileError(fmt::format("{}: {}; expected {}", file.string(), what, kind));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw expected("is a folder");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw expected("cannot be opened; check that it exists and is readable");
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (content.find_first_not_of(" \t\r\n") == std::string::npos) throw expected("is empty");
  YAML::Node root;
  try {
    root = YAML::Load(content);  // skips OpenCV's directive, which is not that of YAML
  } catch (const YAML::Exception& error) {
    throw FileError(
        fmt::format("{}:{}: is not YAML: {}; check indentation, colons, brackets and quotes near here; expected {}",
                    file.string(), std::max(error.mark.line, 0) + 1, error.msg, kind));
  }
  if (!root.IsMap()) throw expected("contains no `key: value` lines");
  return root;
}

}  // namespace panvo::calibration_files

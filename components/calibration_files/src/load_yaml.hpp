// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>

namespace panvo::calibration_files {

/// The map in a file. Throws FileError if the file cannot be read, with what is expected: `kind`.
YAML::Node load_yaml_map(const std::filesystem::path& file, const std::string& kind);

}  // namespace panvo::calibration_files

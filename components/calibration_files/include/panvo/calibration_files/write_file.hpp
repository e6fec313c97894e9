// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "panvo/calibration_files/file_error.hpp"

namespace panvo::calibration_files {

/// Replaces a file atomically: a reader sees the old content or the new one. Throws FileError.
void write_file(const std::filesystem::path& file, const std::string& content);

}  // namespace panvo::calibration_files

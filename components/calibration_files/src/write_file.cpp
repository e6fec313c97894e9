// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/write_file.hpp"

#include <fstream>

namespace panvo::calibration_files {

void write_file(const std::filesystem::path& file, const std::string& content) {
  auto partial = file;
  partial += ".partial";
  std::error_code error;
  std::ofstream stream(partial, std::ios::binary);
  const bool is_written = static_cast<bool>((stream << content).flush());
  stream.close();
  if (is_written) std::filesystem::rename(partial, file, error);
  if (is_written && !error) return;
  std::filesystem::remove(partial, error);
  throw FileError(file.string() + ": cannot be written; choose a folder that exists and is writable");
}

}  // namespace panvo::calibration_files

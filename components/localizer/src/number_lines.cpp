// SPDX-License-Identifier: Apache-2.0
#include "number_lines.hpp"

#include <fstream>

namespace panvo::localizer {

Lines read_lines(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Lines lines;
  for (std::string line; std::getline(stream, line);) {
    const auto space = std::min(line.find(' '), line.size() - 1);
    lines[line.substr(0, space)] = line.substr(space + 1);
  }
  return lines;
}

void write_lines(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::path part = file;
  part += ".part";
  std::ofstream stream(part);
  stream << text;
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(part, file, error);
  if (!stream || error) {
    throw std::runtime_error(
        fmt::format("cannot write {}: name a file in an existing, writable folder with free space", file.string()));
  }
}

}  // namespace panvo::localizer

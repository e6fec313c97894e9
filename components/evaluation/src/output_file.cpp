// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/output_file.hpp"

#include <fstream>

#include "panvo/evaluation/input_error.hpp"

namespace panvo::evaluation {

void write_output(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text).flush()) throw InputError(file, "cannot be written", "choose a writable folder with --out");
}

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace panvo::evaluation {

// Throws InputError if the file cannot be written.
void write_output(const std::filesystem::path& file, const std::string& text);

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace panvo::evaluation {

// The input cannot be evaluated. The message names the file, the line if applicable, and the remedy.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const std::filesystem::path& file, const std::string& problem, const std::string& remedy)
      : std::runtime_error(file.string() + ": " + problem + "; " + remedy) {}
  InputError(const std::filesystem::path& file, std::size_t line, const std::string& problem, const std::string& remedy)
      : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + problem + "; " + remedy) {}
};

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace panvo::runtime {

/// Context at one position of a system file.
struct Scope {
  std::filesystem::path file;
  std::string name_space = "/";
  std::map<std::string, std::string> variables{};
  std::vector<std::pair<std::string, std::string>> remaps{};  // of all components that follow; the last prevail
};

/// A failed substitution, without its position in the file.
class SubstitutionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Replaces each $(...), innermost first. Results are not substituted again. Throws SubstitutionError.
std::string substitute(std::string_view text, const Scope& scope);

/// Resolves `path` relative to the folder of `file`.
std::filesystem::path beside(const std::filesystem::path& file, const std::filesystem::path& path);

}  // namespace panvo::runtime

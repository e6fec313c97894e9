// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

namespace panvo::runtime {

/// What holds at one place of a system file.
struct Scope {
  std::filesystem::path file;
  std::string name_space = "/";
  std::map<std::string, std::string> variables{};
};

/// What is wrong with a substitution, without the place where it stands.
class SubstitutionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Replaces each $(...), innermost first. What comes out is not looked at again. Throws SubstitutionError.
std::string substitute(std::string_view text, const Scope& scope);

/// `path` as seen from the folder of `file`.
std::filesystem::path beside(const std::filesystem::path& file, const std::filesystem::path& path);

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace panvo::runtime {

/// Position of a configured value: "stereo.yaml:17". Line 0: the source has no lines (a command line).
struct Location {
  std::string file;
  int line = 0;

  std::string to_string() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

/// An invalid configuration. Holds all problems found, each with file, line, key and remedy.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<std::string> problems);
  explicit ConfigError(std::string problem) : ConfigError(std::vector<std::string>{std::move(problem)}) {}

  const std::vector<std::string>& problems() const noexcept { return problems_; }

 private:
  std::vector<std::string> problems_;
};

}  // namespace panvo::runtime

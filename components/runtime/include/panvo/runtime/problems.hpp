// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {

/// What is wrong with a configuration, collected until everything has been looked at.
class Problems {
 public:
  void add(Location where, std::string what);
  bool empty() const noexcept { return found_.empty(); }

  /// "stereo.yaml:17: what", each once, in order of line. Files come in the order in which they were first
  /// complained of.
  std::vector<std::string> sorted() const;

  /// Throws ConfigError if there is any.
  void throw_if_any() const;

 private:
  std::vector<std::pair<Location, std::string>> found_;
};

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "panvo/runtime/errors.hpp"

namespace panvo::runtime {

/// Collects the problems of a configuration.
class Problems {
 public:
  void add(Location where, std::string what);
  bool empty() const noexcept { return found_.empty(); }

  /// "stereo.yaml:17: what", without duplicates, in order of line. Files appear in the order of their first problem.
  std::vector<std::string> sorted() const;

  /// Throws ConfigError if there is any.
  void throw_if_any() const;

 private:
  std::vector<std::pair<Location, std::string>> found_;
};

}  // namespace panvo::runtime

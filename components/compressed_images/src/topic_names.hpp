// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace panvo::compressed_images {

/// Splits entries that hold several names separated by spaces, as given on a command line.
inline std::vector<std::string> separate_names(const std::vector<std::string>& entries) {
  std::vector<std::string> names;
  for (const std::string& entry : entries) {
    std::istringstream words(entry);
    for (std::string name; words >> name;) names.push_back(name);
  }
  return names;
}

}  // namespace panvo::compressed_images

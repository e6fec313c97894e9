// SPDX-License-Identifier: Apache-2.0
#include "known_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace panvo::calibration_files {
namespace {

/// Number of insertions, deletions and replacements that turn `a` into `b` (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, diagonal + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string known_keys(const std::string& wrong, const std::set<std::string>& known) {
  if (known.empty()) return "; remove it";
  const auto distance = [&](const std::string& key) {
    return key.starts_with(wrong + "_") ? 1 : edit_distance(wrong, key);  // the unit was forgotten: "yaw"
  };
  const auto nearest = std::min_element(known.begin(), known.end(),
                                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  // A key that differs in more than a third of its characters is not meant.
  const bool is_near = distance(*nearest) <= std::max<std::size_t>(1, wrong.size() / 3);
  return fmt::format("; {}nown keys: {}", is_near ? fmt::format("did you mean {}? K", *nearest) : "k",
                     fmt::join(known, ", "));
}

}  // namespace panvo::calibration_files

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "kept_file.hpp"

#include "panvo/localizer/local_pose_graph.hpp"

namespace panvo::localizer {

/// The numbers of a line. Throws std::runtime_error if it is missing or does not hold `count` finite numbers.
template <class Number>
std::vector<Number> numbers(const Lines& lines, const std::string& key, std::size_t count) {
  const auto line = lines.find(key);
  if (line == lines.end()) throw std::runtime_error(fmt::format("'{}' is missing", key));
  std::vector<Number> values;
  const char* at = line->second.data();
  const char* const end = at + line->second.size();
  while (at != end) {
    if (*at == ' ') {
      ++at;
      continue;
    }
    Number value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc())
      throw std::runtime_error(fmt::format("'{}' contains something that is not a number", key));
    values.push_back(value);
    at = next;
  }
  const bool are_finite = std::ranges::all_of(values, [](auto value) { return std::isfinite(double(value)); });
  if (values.size() != count || !are_finite) {
    throw std::runtime_error(fmt::format("'{}' has {} finite numbers instead of {}", key, values.size(), count));
  }
  return values;
}

/// Which rule of odometry messages, the origin of the values, a pose breaks; nullopt: none.
std::optional<std::string> problem_of(const PoseInMap& pose);

/// Lines "position", "orientation" (x, y, z, w) and "covariance", in the shortest form that reads back exactly.
std::string to_lines(const PoseInMap& pose);
/// The inverse. Throws std::runtime_error if the lines hold no pose without a problem.
PoseInMap pose_of(const Lines& lines);

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::runtime {

/// Minimum number of insertions, deletions, replacements and swaps of neighbouring characters that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Text to append to a message about an unknown name: `; did you mean "max_features"?` if a known name is similar,
/// otherwise the list `; known are: a, b` (`; there are none` if empty). Also matches dotted names whose group is
/// missing.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& known);

}  // namespace panvo::runtime

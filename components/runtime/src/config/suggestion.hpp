// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::runtime {

/// Least number of characters to insert, delete, replace, or swap with their neighbour, to get from `a` to
/// `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// What to append to a message on an unknown name: `; did you mean "max_features"?` if one of the known names
/// is near, else all of them: `; known are: a, b` (`; there are none` if there are none). The group of a
/// dotted name may have been forgotten.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& known);

}  // namespace panvo::runtime

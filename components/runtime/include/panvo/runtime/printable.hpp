// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace panvo::runtime {

/// A text of which parts come from others (names of topics and nodes, what messages hold), fit for a terminal: what would steer it, and
/// bytes that are no UTF-8, as \x1b. Ends of lines and tabs stay.
std::string printable(std::string_view text);

}  // namespace panvo::runtime

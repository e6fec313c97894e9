// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace panvo::runtime {

/// Makes a text with foreign parts (topic and node names, message contents) safe for a terminal: control characters and
/// invalid UTF-8 bytes become `\x1b` and the like. Newlines and tabs are kept.
std::string printable(std::string_view text);

}  // namespace panvo::runtime

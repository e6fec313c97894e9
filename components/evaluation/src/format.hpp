// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace panvo::evaluation {

// `digits` decimals, or significant digits for chars_format::general; independent of the locale.
inline std::string to_text(double value, int digits, std::chars_format format = std::chars_format::fixed) {
  std::array<char, 400> buffer;  // a fixed double has at most 309 digits before the point
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, digits);
  return {buffer.data(), result.ptr};
}

}  // namespace panvo::evaluation

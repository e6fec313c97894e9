// SPDX-License-Identifier: Apache-2.0
#include "panvo/runtime/printable.hpp"

#include <spdlog/fmt/fmt.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace panvo::runtime {
namespace {

/// Decodes the first character of `text` and returns its number of bytes; 0 if invalid.
std::size_t read_utf8(std::string_view text, std::uint32_t& character) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  if (byte(0) < 0x80) {
    character = byte(0);
    return 1;
  }
  const int ones = std::countl_one(byte(0));
  if (ones < 2 || ones > 4 || text.size() < static_cast<std::size_t>(ones)) return 0;
  const auto size = static_cast<std::size_t>(ones);
  character = byte(0) & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    character = character << 6 | (byte(i) & 0x3fU);
  }
  constexpr std::uint32_t kMin[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = character >= 0xd800 && character < 0xe000;
  return character < kMin[size] || is_surrogate || character > 0x10ffff ? 0 : size;
}

/// C0 and C1 control characters, and bidirectional formatting characters, which can disguise a text.
bool steers_a_terminal(std::uint32_t character) {
  return (character < 0x20 && character != '\n' && character != '\t') || (character >= 0x7f && character < 0xa0) ||
         (character >= 0x202a && character <= 0x202e) || (character >= 0x2066 && character <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    std::uint32_t character = 0;
    const std::size_t size = read_utf8(text, character);
    const bool as_it_is = size > 0 && !steers_a_terminal(character);
    const std::size_t taken = size > 0 ? size : 1;
    for (const char byte : text.substr(0, taken)) {
      if (as_it_is) {
        shown += byte;
      } else {
        fmt::format_to(std::back_inserter(shown), "\\x{:02x}", static_cast<std::uint8_t>(byte));
      }
    }
    text.remove_prefix(taken);
  }
  return shown;
}

}  // namespace panvo::runtime

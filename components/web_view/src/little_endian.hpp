// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace panvo::web_view {

/// `bytes` has at least four.
inline std::uint32_t read_u32(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

/// `bytes` has at least eight.
inline std::uint64_t read_u64(std::span<const std::uint8_t> bytes) {
  return read_u32(bytes) | (std::uint64_t{read_u32(bytes.subspan(4))} << 32);
}

template <std::unsigned_integral Integer>
void append(std::vector<std::uint8_t>& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
}

}  // namespace panvo::web_view

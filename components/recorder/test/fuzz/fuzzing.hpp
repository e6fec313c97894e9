// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t limit);

/// libFuzzer's functions with string arguments.
namespace panvo::recorder::fuzz {

/// libFuzzer's own mutator.
inline std::string mutate_bytes(std::string bytes, std::size_t limit) {
  const auto size = bytes.size();
  bytes.resize(std::max<std::size_t>({size, limit, 1}));
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), std::min(size, bytes.size()),
                                std::max<std::size_t>(limit, 1)));
  return bytes;
}

/// Copies the result of a custom mutator to libFuzzer's buffer; returns its size.
inline std::size_t hand_back(const std::string& bytes, std::uint8_t* data, std::size_t limit) {
  const auto size = std::min(bytes.size(), limit);
  std::memcpy(data, bytes.data(), size);
  return size;
}

}  // namespace panvo::recorder::fuzz

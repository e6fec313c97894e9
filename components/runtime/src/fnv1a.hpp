// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace panvo::runtime {

constexpr std::uint64_t kFnv1aStart = 14695981039346656037ULL;

/// FNV-1a hash of bytes: the same on every platform. `start` is a seed, or the hash of preceding bytes.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t start = kFnv1aStart) noexcept {
  std::uint64_t hash = start;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return hash;
}

}  // namespace panvo::runtime

// SPDX-License-Identifier: Apache-2.0
#include "panvo/sqlite/file_header.hpp"

#include <span>

namespace panvo::sqlite {
namespace {

std::uint32_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = 0;
  for (const auto byte : bytes) value = value << 8 | byte;
  return value;
}

}  // namespace

std::uint64_t stated_bytes(const FileHeader& header) noexcept {
  const std::span bytes(header);
  const auto page_size = big_endian(bytes.subspan(16, 2));
  const auto pages = big_endian(bytes.subspan(28, 4));
  // Versions of SQLite that do not know the number of pages change the first counter alone.
  const bool is_valid = big_endian(bytes.subspan(24, 4)) == big_endian(bytes.subspan(92, 4));
  return is_valid ? std::uint64_t{page_size == 1 ? 65536 : page_size} * pages : 0;
}

}  // namespace panvo::sqlite

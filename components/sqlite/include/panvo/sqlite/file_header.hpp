// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace panvo::sqlite {

/// The first bytes of an SQLite file [https://www.sqlite.org/fileformat.html, section 1.3].
using FileHeader = std::array<std::uint8_t, 100>;

/// Size of the whole file in bytes according to its header; 0 if the header states no valid size. A file that is
/// shorter has been truncated, which SQLite does not notice: it fills the last page with zeros.
std::uint64_t stated_bytes(const FileHeader& header) noexcept;

}  // namespace panvo::sqlite

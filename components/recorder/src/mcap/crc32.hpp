// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>

namespace panvo::recorder::mcap {

/// CRC-32 of zip, PNG and MCAP (IEEE 802.3, reflected).
inline std::uint32_t crc32(std::span<const std::uint8_t> bytes) noexcept {
  return static_cast<std::uint32_t>(::crc32_z(0, bytes.data(), bytes.size()));
}

}  // namespace panvo::recorder::mcap

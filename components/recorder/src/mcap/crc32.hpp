// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace panvo::recorder::mcap {

/// CRC-32 of zip, PNG and MCAP (IEEE 802.3, reflected). `before`: CRC of the preceding bytes.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0) noexcept;

}  // namespace panvo::recorder::mcap

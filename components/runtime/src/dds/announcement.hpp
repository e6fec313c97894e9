// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace panvo::runtime::dds {

/// Whether an RTPS message announces a participant: it contains unprotected DATA of the SPDP writer
/// [RTPS 2.2, 8.5.3 and 9.4]. False for malformed messages.
bool is_announcement(std::span<const std::uint8_t> message);

}  // namespace panvo::runtime::dds

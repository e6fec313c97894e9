// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::interfaces {

/// Stamps of messages end here, in 2038: they have 31 bits for the seconds.
inline constexpr std::int64_t kEndOfStamps_ns = (std::int64_t{1} << 31) * 1'000'000'000;

}  // namespace panvo::interfaces

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace panvo::runtime::dds {

/// Limits of a service.
struct RequestLimits {
  double per_s = 0;
  std::uint32_t size = 0;  ///< bytes
};

}  // namespace panvo::runtime::dds

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace panvo::simulation {

/// 0 up to `share` = 0 and 1 from `share` = 1 on, without a kink between.
inline double smooth_step(double share) {
  const double inside = std::clamp(share, 0.0, 1.0);
  return inside * inside * (3.0 - 2.0 * inside);
}

}  // namespace panvo::simulation

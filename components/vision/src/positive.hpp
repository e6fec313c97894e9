// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace panvo::vision {

inline bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace panvo::vision

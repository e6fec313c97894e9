// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace panvo::evaluation {

inline constexpr double kDegrees = 180.0 / std::numbers::pi;  ///< in a radian
inline constexpr double kRadians = std::numbers::pi / 180.0;  ///< in a degree

}  // namespace panvo::evaluation

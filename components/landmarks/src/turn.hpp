// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace panvo::landmarks {

inline constexpr double kTurn = 2.0 * std::numbers::pi;  ///< a full turn, rad

}  // namespace panvo::landmarks

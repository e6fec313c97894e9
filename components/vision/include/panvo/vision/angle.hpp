// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::vision {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< rad

/// The angle in (-pi, pi].
inline double wrapped(double angle_rad) { return wrap(angle_rad, 2.0 * std::numbers::pi); }

}  // namespace panvo::vision

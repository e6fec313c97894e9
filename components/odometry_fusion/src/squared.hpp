// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::odometry_fusion {

inline double squared(double value) { return value * value; }

}  // namespace panvo::odometry_fusion

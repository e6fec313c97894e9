// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// Where in a camera's images corners were seen: in cells of a grid.
struct Coverage {
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;
  static constexpr double kGood = 0.75;  ///< share that does; what the rest of the image shows is the model's guess

  std::array<int, kColumns * kRows> corners{};  ///< row by row
  double share = 0.0;                           ///< of cells with any
};

Coverage coverage(const Observations& observations, std::size_t camera);

}  // namespace panvo::calibration

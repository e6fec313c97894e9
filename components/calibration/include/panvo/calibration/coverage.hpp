// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "panvo/calibration/observations.hpp"

namespace panvo::calibration {

/// Number of corners in each cell of a grid over a camera's image.
struct Coverage {
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;
  static constexpr double kGood = 0.75;  ///< sufficient share; the model extrapolates in the rest of the image

  std::array<int, kColumns * kRows> corners{};  ///< row by row
  double share = 0.0;                           ///< fraction of cells with corners
};

Coverage coverage(const Observations& observations, std::size_t camera);

}  // namespace panvo::calibration

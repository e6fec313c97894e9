// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::localizer {

/// A number with its standard deviation.
struct Estimate {
  double value = 0.0, sigma = 0.0;
};

}  // namespace panvo::localizer

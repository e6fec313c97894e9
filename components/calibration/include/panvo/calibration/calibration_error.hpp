// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::calibration {

/// What was given cannot be calibrated with. The message names the file (and line and key where there are such), what is wrong with it and
/// the remedy.
class CalibrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::calibration

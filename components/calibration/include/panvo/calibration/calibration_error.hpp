// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::calibration {

/// The input cannot be used for a calibration. The message names the file (line and key, if any), the fault and the
/// remedy.
class CalibrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::calibration

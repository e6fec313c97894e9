// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::calibration_files {

/// A calibration file that cannot be used or written. The message has a line for each problem:
/// "left.yaml:7: camera_matrix ...", with the remedy.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::calibration_files

// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::calibration {

/// While it lives, Ctrl-C and SIGTERM are remembered instead of ending the process; a second one ends it at once.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool came();
};

}  // namespace panvo::calibration

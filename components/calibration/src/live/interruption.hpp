// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::calibration {

/// During its lifetime the first SIGINT or SIGTERM is recorded instead of ending the process; a second one ends it.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool came();
};

}  // namespace panvo::calibration

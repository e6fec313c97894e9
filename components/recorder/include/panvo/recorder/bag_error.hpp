// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::recorder {

/// A bag cannot be written or read. The message names the file, the fault and the remedy.
class BagError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::recorder

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::landmarks {

/// A landmark store cannot be used: the message names the file, the problem and the remedy.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::landmarks

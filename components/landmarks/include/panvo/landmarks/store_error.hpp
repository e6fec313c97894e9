// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::landmarks {

/// A landmark store that cannot be used: the message names the file, what is wrong with it and what to do.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::landmarks

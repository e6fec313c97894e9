// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::recorder {

/// A bag that cannot be written or read: the message names the file, what is wrong with it and what to do.
class BagError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace panvo::recorder

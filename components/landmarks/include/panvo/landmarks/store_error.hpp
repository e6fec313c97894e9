// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace panvo::landmarks {

/// A landmark store cannot be used: the message names the location, the problem and the remedy.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A server cannot be reached, or refuses for now (full disk, missing rights), or another process holds the lock of a
/// file. The same call may succeed later; until then, nothing of it is stored.
class StoreUnavailable : public StoreError {
 public:
  using StoreError::StoreError;
};

}  // namespace panvo::landmarks

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::localizer {

/// Something that speaks against the pose and that its covariance does not know of.
struct Doubt {
  double off_m = 0.0;        ///< by how much the pose is off if it is right, horizontally
  bool forbids_use = false;  ///< the pose should not be used before it is settled
  std::string reason;
};

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace panvo::localizer {

/// Evidence against the pose that is not in its covariance.
struct Doubt {
  double off_m = 0.0;        ///< horizontal error of the pose if the doubt is justified
  bool forbids_use = false;  ///< the pose should not be used until resolved
  std::string reason;
};

}  // namespace panvo::localizer

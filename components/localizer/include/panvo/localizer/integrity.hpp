// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {

struct IntegrityParameters {
  double risk = 1e-3;
  double tail = 30.0;
  double alert_limit_m = 2.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = IntegrityParameters;
    field(&P::risk, "risk", "1", "probability that the horizontal error exceeds the protection level", 1e-9, 0.5);
    field(
        &P::tail, "tail", "1",
        "degrees of freedom of the error distribution (Student's t): fewer mean more errors beyond the "
        "covariance; at 30, the level for a risk of 0.001 also holds for normal errors with 1.2 times the variance, at "
        "10 with 1.9 times",
        2.0, 1000.0);
    field(&P::alert_limit_m, "alert_limit_m", "m", "largest protection level of a usable pose", 0.01, 1e4);
  }
};

/// Whether a pose is usable.
struct Integrity {
  bool is_usable = false;
  std::string reason;             ///< why it is not
  double protection_level_m = 0;  ///< horizontal
};

/// Radius that a horizontal error exceeds with probability `risk`, if it has a Student distribution with `tail` degrees
/// of freedom and this covariance's ellipse. Where that is a circle, P(error > r sigma) = (1 + r^2 / tail)^(-tail / 2).
double protection_radius(const Eigen::Matrix2d& covariance, double risk, double tail);

/// The protection level is that of the covariance plus the offset of each doubt.
Integrity assess(const LocalizedPose& pose, const std::vector<Doubt>& doubts, const IntegrityParameters& parameters);

}  // namespace panvo::localizer

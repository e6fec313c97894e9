// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {

struct IntegrityParameters {
  double risk = 1e-3;
  double tail = 10.0;
  double alert_limit_m = 2.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = IntegrityParameters;
    field(&P::risk, "risk", "1", "probability that the horizontal error exceeds the protection level", 1e-9, 0.5);
    field(
        &P::tail, "tail", "1",
        "degrees of freedom of the errors' distribution (Student's t): the fewer, the more often they exceed what the "
        "covariance says; at 10 the level at a risk of 0.001 also holds for normal errors of twice the variance",
        2.0, 1000.0);
    field(&P::alert_limit_m, "alert_limit_m", "m", "the largest protection level at which the pose may be used", 0.01,
          1e4);
  }
};

/// Whether a pose may be used.
struct Integrity {
  bool is_usable = false;
  std::string reason;             ///< why not
  double protection_level_m = 0;  ///< horizontal
};

/// How many standard deviations an error in the plane stays below but for `risk`, when both of its components have a Student distribution
/// of `tail` degrees of freedom: P(error > r sigma) = (1 + r^2 / tail)^(-tail / 2).
double protection_factor(double risk, double tail);

/// The level is that of the covariance, along its worst direction, and what each doubt adds, which no covariance knows of.
Integrity assess(const LocalizedPose& pose, const std::vector<Doubt>& doubts, const IntegrityParameters& parameters);

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/integrity.hpp"

#include <fmt/format.h>

#include <cmath>

namespace panvo::localizer {

double protection_factor(double risk, double tail) { return std::sqrt(tail * (std::pow(risk, -2.0 / tail) - 1.0)); }

Integrity assess(const LocalizedPose& pose, const std::vector<Doubt>& doubts, const IntegrityParameters& parameters) {
  Integrity integrity;
  integrity.protection_level_m =
      protection_factor(parameters.risk, parameters.tail) * vision::horizontal_sigma(pose.covariance);
  for (const auto& doubt : doubts) {
    integrity.protection_level_m += doubt.off_m;
    if (doubt.forbids_use && integrity.reason.empty()) integrity.reason = doubt.reason;
  }
  const bool is_known = pose.state == State::kTracking || pose.state == State::kRelocalised;
  if (!is_known) {
    integrity.reason = pose.reason.empty() ? to_text(pose.state) : to_text(pose.state) + ": " + pose.reason;
  } else if (integrity.reason.empty() && !(integrity.protection_level_m <= parameters.alert_limit_m)) {
    integrity.reason = fmt::format("protection level {:.2f} m exceeds the alert limit of {:.2f} m",
                                   integrity.protection_level_m, parameters.alert_limit_m);
  }
  integrity.is_usable = integrity.reason.empty();
  return integrity;
}

}  // namespace panvo::localizer

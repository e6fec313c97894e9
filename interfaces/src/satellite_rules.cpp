// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/satellite_rules.hpp"

#include "validity_parts.hpp"

namespace sensor_msgs::msg {

std::optional<std::string> problem_of(const NavSatFix& message) {
  panvo::interfaces::Check check;
  panvo::interfaces::check_header(check, message.header());
  if (message.status().status() < NavSatStatus_Constants::STATUS_FIX) return check.problem();
  check.within("latitude", message.latitude(), -90.0, 90.0);
  check.within("longitude", message.longitude(), -360.0, 360.0);  // also 0 to 360
  if (message.position_covariance_type() != NavSatFix_Constants::COVARIANCE_TYPE_UNKNOWN)
    check.covariance("position_covariance", message.position_covariance());
  return check.problem();
}

}  // namespace sensor_msgs::msg

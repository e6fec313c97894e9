// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/satellite_rules.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace sensor_msgs::msg {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

NavSatFix valid() {
  NavSatFix fix;
  fix.status().status(NavSatStatus_Constants::STATUS_FIX);
  fix.latitude(48.1);
  fix.longitude(11.6);
  fix.altitude(kNan);
  fix.position_covariance({4.0, 0.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 16.0});
  fix.position_covariance_type(NavSatFix_Constants::COVARIANCE_TYPE_DIAGONAL_KNOWN);
  return fix;
}

template <class Change>
std::string problem(const Change& change) {
  auto fix = valid();
  change(fix);
  return problem_of(fix).value_or("none");
}

TEST(SatelliteRules, NameWhatAFixMayNotContain) {
  EXPECT_EQ(problem([](NavSatFix&) {}), "none");
  EXPECT_TRUE(problem([](NavSatFix& fix) { fix.latitude(111.6); }).starts_with("latitude"));
  EXPECT_TRUE(problem([](NavSatFix& fix) { fix.longitude(kNan); }).starts_with("longitude"));
  for (const double variance : {-1.0, kNan})
    EXPECT_TRUE(problem([&](NavSatFix& fix) { fix.position_covariance()[4] = variance; }).starts_with("position_cov"));
  EXPECT_TRUE(problem([](NavSatFix& fix) {
                fix.position_covariance()[1] = fix.position_covariance()[3] = 50.0;
              }).starts_with("position_covariance"));
}

TEST(SatelliteRules, LeaveOutWhatIsNotStated) {
  EXPECT_EQ(problem([](NavSatFix& fix) {
              fix.status().status(NavSatStatus_Constants::STATUS_NO_FIX);
              fix.latitude(kNan);
            }),
            "none");
  EXPECT_EQ(problem([](NavSatFix& fix) {
              fix.position_covariance_type(NavSatFix_Constants::COVARIANCE_TYPE_UNKNOWN);
              fix.position_covariance()[0] = kNan;
            }),
            "none");
}

}  // namespace
}  // namespace sensor_msgs::msg

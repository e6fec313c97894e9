// SPDX-License-Identifier: Apache-2.0
#include "gnss_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace panvo::localizer {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

sensor_msgs::msg::NavSatFix valid() {
  sensor_msgs::msg::NavSatFix fix;
  fix.status().status(sensor_msgs::msg::NavSatStatus_Constants::STATUS_FIX);
  fix.latitude(48.1);
  fix.longitude(11.6);
  fix.altitude(520.0);
  fix.position_covariance({4.0, 0.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 16.0});
  fix.position_covariance_type(sensor_msgs::msg::NavSatFix_Constants::COVARIANCE_TYPE_DIAGONAL_KNOWN);
  return fix;
}

TEST(GnssMessages, TakeTheStatedCovariance) {
  const auto position = to_position(valid());
  ASSERT_TRUE(position) << position.reason();
  EXPECT_EQ(position->point.latitude_deg, 48.1);
  EXPECT_NEAR(position->covariance(1, 1), 9.0, 1e-3);
}

TEST(GnssMessages, AssumeTheUsualCovarianceIfNoneIsStated) {
  auto unknown = valid();
  unknown.position_covariance_type(sensor_msgs::msg::NavSatFix_Constants::COVARIANCE_TYPE_UNKNOWN);
  EXPECT_EQ(to_position(unknown)->covariance(0, 0), 25.0);
  auto zero = valid();
  zero.position_covariance({});
  EXPECT_EQ(to_position(zero)->covariance(0, 0), 25.0);
}

TEST(GnssMessages, UseAPositionWithoutAltitudeInThePlaneOnly) {
  auto flat = valid();
  flat.altitude(kNan);
  const auto position = to_position(flat);
  ASSERT_TRUE(position) << position.reason();
  EXPECT_EQ(position->point.altitude_m, 0.0);
  EXPECT_GT(position->covariance(2, 2), 1e7);
}

TEST(GnssMessages, NameWhatIsWrong) {
  const auto reason = [](auto change) {
    auto fix = valid();
    change(fix);
    return to_position(fix).reason();
  };
  using Fix = sensor_msgs::msg::NavSatFix;
  using ::testing::HasSubstr;
  EXPECT_THAT(reason([](Fix& fix) { fix.status().status(-1); }), HasSubstr("NO_FIX"));
  EXPECT_THAT(reason([](Fix& fix) { fix.longitude(kNan); }), HasSubstr("not finite"));
  EXPECT_THAT(reason([](Fix& fix) { fix.latitude(111.6); }), HasSubstr("exchanged"));
  EXPECT_THAT(reason([](Fix& fix) {
                fix.latitude(0.0);
                fix.longitude(0.0);
              }),
              HasSubstr("no position yet"));
  EXPECT_THAT(reason([](Fix& fix) { fix.position_covariance()[4] = -1.0; }), HasSubstr("negative"));
  EXPECT_THAT(reason([](Fix& fix) { fix.position_covariance()[0] = kNan; }), HasSubstr("not finite"));
  EXPECT_THAT(reason([](Fix& fix) { fix.position_covariance()[1] = fix.position_covariance()[3] = 50.0; }),
              HasSubstr("positive semidefinite"));
}

}  // namespace
}  // namespace panvo::localizer

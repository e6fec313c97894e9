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
  const auto position = to_position(valid(), 400.0);
  ASSERT_TRUE(position) << position.reason();
  EXPECT_EQ(position->point.latitude_deg, 48.1);
  EXPECT_EQ(position->point.altitude_m, 520.0);
  EXPECT_NEAR(position->covariance(1, 1), 9.0, 1e-3);
}

TEST(GnssMessages, AssumeTheUsualCovarianceIfNoneIsStated) {
  auto unknown = valid();
  unknown.position_covariance_type(sensor_msgs::msg::NavSatFix_Constants::COVARIANCE_TYPE_UNKNOWN);
  EXPECT_EQ(to_position(unknown, 400.0)->covariance(0, 0), 25.0);
  auto zero = valid();
  zero.position_covariance({});
  EXPECT_EQ(to_position(zero, 400.0)->covariance(0, 0), 25.0);
  auto flat = valid();
  flat.position_covariance({4.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(to_position(flat, 400.0)->covariance(1, 1), 4.0, 1e-3);
  EXPECT_EQ(to_position(flat, 400.0)->covariance(2, 2), 100.0);
}

TEST(GnssMessages, UseAPositionWithoutAltitudeInThePlaneOnly) {
  auto flat = valid();
  flat.altitude(kNan);
  const auto position = to_position(flat, 400.0);
  ASSERT_TRUE(position) << position.reason();
  EXPECT_EQ(position->point.altitude_m, 400.0);
  EXPECT_GT(position->covariance(2, 2), 1e7);
}

TEST(GnssMessages, SayWhyThereIsNoPosition) {
  auto lost = valid();
  lost.status().status(sensor_msgs::msg::NavSatStatus_Constants::STATUS_NO_FIX);
  EXPECT_THAT(to_position(lost, 400.0).reason(), ::testing::HasSubstr("NO_FIX"));
  auto nowhere = valid();
  nowhere.latitude(0.0);
  nowhere.longitude(0.0);
  EXPECT_THAT(to_position(nowhere, 400.0).reason(), ::testing::HasSubstr("no position yet"));
}

}  // namespace
}  // namespace panvo::localizer

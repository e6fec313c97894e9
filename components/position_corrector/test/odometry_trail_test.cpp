// SPDX-License-Identifier: Apache-2.0
#include "odometry_trail.hpp"

#include <gtest/gtest.h>

namespace panvo::position_corrector {
namespace {

constexpr std::int64_t kPeriod_ns = 40'000'000;

OdometrySample sample(std::int64_t stamp_ns, double x_m, double speed_m_s, double sigma_m = 0.5) {
  OdometrySample made{stamp_ns, {Eigen::Vector3d(x_m, 0.0, 0.0), sigma_m}, vision::Vector6d::Zero()};
  made.twist[0] = speed_m_s;
  return made;
}

TEST(OdometryTrail, KnowsNothingBeforeTheFirstMessage) { EXPECT_FALSE(OdometryTrail().at(5)); }

TEST(OdometryTrail, HasTheWayThatWasDriven) {
  OdometryTrail trail;
  for (int i = 0; i <= 25; ++i) trail.add(sample(i * kPeriod_ns, 0.2 * i, 5.0));
  EXPECT_NEAR(trail.at(25 * kPeriod_ns)->travelled_m, 5.0, 1e-9);
}

TEST(OdometryTrail, CountsACorrectionsJumpAsNoWay) {
  OdometryTrail trail;
  for (int i = 0; i <= 10; ++i) trail.add(sample(i * kPeriod_ns, 0.2 * i, 5.0));
  trail.add(sample(11 * kPeriod_ns, 2.2 + 30.0, 5.0, 0.1));
  const auto here = trail.at(11 * kPeriod_ns);
  ASSERT_TRUE(here);
  EXPECT_NEAR(here->travelled_m, 2.2, 1e-9);
  EXPECT_DOUBLE_EQ(here->prior.position.x(), 32.2);
  EXPECT_DOUBLE_EQ(here->prior.sigma_m, 0.1) << "the uncertainty comes with the position";
}

TEST(OdometryTrail, TellsWhereTheVehicleWasWhenALatePanoramaWasTaken) {
  OdometryTrail trail;
  for (int i = 0; i <= 25; ++i) trail.add(sample(i * kPeriod_ns, 0.2 * i, 5.0));
  const auto then = trail.at(10 * kPeriod_ns + kPeriod_ns / 4);
  ASSERT_TRUE(then);
  EXPECT_NEAR(then->prior.position.x(), 2.05, 1e-9);
  EXPECT_NEAR(then->travelled_m, 2.05, 1e-9);
  EXPECT_NEAR(then->twist[0], 5.0, 1e-12);
}

TEST(OdometryTrail, TakesTheNearestBeforeTheFirstAndAfterTheLast) {
  OdometryTrail trail;
  trail.add(sample(100, 1.0, 0.0));
  trail.add(sample(200, 2.0, 0.0));
  EXPECT_DOUBLE_EQ(trail.at(50)->prior.position.x(), 1.0);
  EXPECT_DOUBLE_EQ(trail.at(300)->prior.position.x(), 2.0);
}

TEST(OdometryTrail, LeavesOutWhatIsNotAfterTheLast) {
  OdometryTrail trail;
  trail.add(sample(200, 2.0, 5.0));
  trail.add(sample(200, 7.0, 5.0));
  trail.add(sample(100, 7.0, 5.0));
  EXPECT_DOUBLE_EQ(trail.at(200)->prior.position.x(), 2.0);
}

}  // namespace
}  // namespace panvo::position_corrector

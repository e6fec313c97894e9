// SPDX-License-Identifier: Apache-2.0
#include "odometry_trail.hpp"

#include <gtest/gtest.h>

namespace panvo::position_corrector {
namespace {

constexpr std::int64_t kFrame_ns = 40'000'000;

OdometrySample sample(std::int64_t stamp_ns, double x_m, double speed_m_s, double sigma_m = 0.5) {
  OdometrySample made{stamp_ns, {Eigen::Vector3d(x_m, 0.0, 0.0), sigma_m}, vision::Vector6d::Zero()};
  made.twist[0] = speed_m_s;
  return made;
}

TEST(OdometryTrail, KnowsNothingBeforeTheFirstMessage) { EXPECT_FALSE(OdometryTrail().at(5)); }

TEST(OdometryTrail, HasTheWayThatWasDriven) {
  OdometryTrail trail;
  for (int i = 0; i <= 25; ++i) trail.add(sample(i * kFrame_ns, 0.2 * i, 5.0));
  EXPECT_NEAR(trail.at(25 * kFrame_ns)->travelled_m, 5.0, 1e-9);
}

TEST(OdometryTrail, CountsACorrectionsJumpAsNoWay) {
  OdometryTrail trail;
  for (int i = 0; i <= 10; ++i) trail.add(sample(i * kFrame_ns, 0.2 * i, 5.0));
  trail.add(sample(11 * kFrame_ns, 2.2 + 30.0, 5.0, 0.1));
  const auto here = trail.at(11 * kFrame_ns);
  ASSERT_TRUE(here);
  EXPECT_NEAR(here->travelled_m, 2.2, 1e-9);
  EXPECT_DOUBLE_EQ(here->prior.position.x(), 32.2);
  EXPECT_DOUBLE_EQ(here->prior.sigma_m, 0.1) << "the uncertainty comes with the position";
}

TEST(OdometryTrail, TellsWhereTheVehicleWasWhenALatePanoramaWasTaken) {
  OdometryTrail trail;
  for (int i = 0; i <= 25; ++i) trail.add(sample(i * kFrame_ns, 0.2 * i, 5.0));
  const auto then = trail.at(10 * kFrame_ns + kFrame_ns / 4);
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

/// At 5 m/s; the clock is set back by ten minutes after the first 100 messages.
class AClockThatIsSetBack : public testing::Test {
 protected:
  static constexpr int kBefore = 100, kConfirming = 5;

  static std::int64_t stamp_ns(int i) { return (1'000 - (i < kBefore ? 0 : 600)) * 1'000'000'000LL + i * kFrame_ns; }

  void drive_to(int end) {
    for (; next < end; ++next) trail.add(sample(stamp_ns(next), 0.2 * next, 5.0));
  }

  OdometryTrail trail;
  int next = 0;
};

TEST_F(AClockThatIsSetBack, IsFollowed) {
  drive_to(kBefore + kConfirming);
  for (; next < kBefore + 1000; drive_to(next + 1)) {
    EXPECT_DOUBLE_EQ(trail.at(stamp_ns(next - 1))->prior.position.x(), 0.2 * (next - 1));
  }
  EXPECT_NEAR(trail.at(stamp_ns(next - 50) - kFrame_ns / 4)->prior.position.x(), 0.2 * (next - 50) - 0.05, 1e-9);
}

TEST_F(AClockThatIsSetBack, EndsTheStampsButNotTheWay) {
  drive_to(kBefore);
  const double before_m = trail.at(stamp_ns(kBefore - 1))->travelled_m;
  drive_to(kBefore + kConfirming);
  const auto here = trail.at(stamp_ns(next - 1));
  EXPECT_DOUBLE_EQ(here->prior.position.x(), 0.2 * (next - 1));
  EXPECT_NEAR(here->travelled_m, before_m, 1e-9) << "the way while it is not certain is unknown";
  EXPECT_DOUBLE_EQ(trail.at(stamp_ns(kBefore - 1))->prior.position.x(), 0.2 * (next - 1)) << "the latest";
  drive_to(kBefore + kConfirming + 10);
  EXPECT_NEAR(trail.at(stamp_ns(next - 1))->travelled_m, before_m + 2.0, 1e-9);
}

TEST_F(AClockThatIsSetBack, IsNotTakenFromSingleMessages) {
  for (int i = 0; i < 20; ++i) {
    drive_to(next + 1);
    trail.add(sample(stamp_ns(kBefore + i), 7.0, 5.0));
  }
  EXPECT_DOUBLE_EQ(trail.at(stamp_ns(next - 1))->prior.position.x(), 0.2 * (next - 1));
  EXPECT_NEAR(trail.at(stamp_ns(next - 1))->travelled_m, 0.2 * (next - 1), 1e-9);
}

}  // namespace
}  // namespace panvo::position_corrector

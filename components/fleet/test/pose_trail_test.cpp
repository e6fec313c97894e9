// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/pose_trail.hpp"

#include <gtest/gtest.h>

namespace panvo::fleet {
namespace {

/// A robot at 5 m/s with 10 poses per second, whose clock is set back by ten minutes after the first 100.
class PoseTrailTest : public testing::Test {
 protected:
  static constexpr int kBefore = 100, kConfirming = 5;
  static constexpr std::int64_t kInterval_ns = 100'000'000;

  static std::int64_t stamp_ns(int i) { return (10'000 - (i < kBefore ? 0 : 6'000) + i) * kInterval_ns; }
  static double x_m(int i) { return 0.5 * i; }

  void add(std::int64_t stamp_ns, double x_m) {
    trail.add(stamp_ns, Eigen::Isometry3d(Eigen::Translation3d(x_m, 0.0, 0.0)), vision::Matrix6d::Identity(), 5.0);
  }

  void drive_to(int end) {
    for (; next < end; ++next) add(stamp_ns(next), x_m(next));
  }

  PoseTrail trail;
  int next = 0;
};

TEST_F(PoseTrailTest, InterpolatesBetweenItsPosesOnly) {
  EXPECT_FALSE(trail.at(stamp_ns(0)));
  drive_to(10);
  const auto sample = trail.at(stamp_ns(4) + kInterval_ns / 4);
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->map_from_base.translation().x(), x_m(4) + 0.125, 1e-9);
  EXPECT_NEAR(sample->travelled_m, x_m(4) + 0.125, 1e-9);
  EXPECT_FALSE(trail.at(stamp_ns(0) - 1));
  EXPECT_FALSE(trail.at(stamp_ns(9) + 1));
}

TEST_F(PoseTrailTest, FollowsAClockThatIsSetBack) {
  drive_to(kBefore);
  const double before_m = trail.latest()->travelled_m;
  drive_to(kBefore + kConfirming);
  for (; next < kBefore + 1000; drive_to(next + 1)) {
    const auto sample = trail.at(stamp_ns(next - 1));
    ASSERT_TRUE(sample) << next;
    EXPECT_DOUBLE_EQ(sample->map_from_base.translation().x(), x_m(next - 1));
  }
  EXPECT_NEAR(trail.latest()->travelled_m, before_m + x_m(1000 - kConfirming), 1e-9) << "the path goes on";
}

TEST_F(PoseTrailTest, KnowsNoPoseOfTheTimeBeforeTheClockWasSetBack) {
  drive_to(kBefore + kConfirming);
  EXPECT_FALSE(trail.at(stamp_ns(kBefore - 1)));
}

TEST_F(PoseTrailTest, DropsSingleLatePoses) {
  for (int i = 0; i < 20; ++i) {
    drive_to(next + 1);
    add(stamp_ns(kBefore + i), 7.0);
  }
  EXPECT_DOUBLE_EQ(trail.latest()->map_from_base.translation().x(), x_m(next - 1));
  EXPECT_NEAR(trail.latest()->travelled_m, x_m(next - 1), 1e-9);
}

}  // namespace
}  // namespace panvo::fleet

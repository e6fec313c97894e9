// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/junction_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace panvo::landmark_builder {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Drives along x, one metre per panorama, past junctions that are detected within 7 m, with centres slightly off.
class Passage {
 public:
  explicit Passage(std::vector<Eigen::Vector2d> junctions) : junctions_(std::move(junctions)) {}

  void drive(double from_m, double to_m) {
    for (double x = from_m; x < to_m; x += 1.0) step({x, 0.0});
  }
  void step(const Eigen::Vector2d& position) {
    std::optional<SeenJunction> seen;
    for (const auto& junction : junctions_) {
      const double side = stamp_ % 2 == 0 ? 1.5 : -1.5;
      if ((junction - position).norm() < 7.0) seen = SeenJunction{junction + Eigen::Vector2d(side, 0.5), 3};
    }
    add(position, seen);
  }
  void add(const Eigen::Vector2d& position, const std::optional<SeenJunction>& seen) {
    for (const auto& junction : filter.add(++stamp_, position, seen)) passed.push_back(junction);
  }

  JunctionFilter filter{JunctionFilterParameters{}};
  std::vector<PassedJunction> passed;

 private:
  std::vector<Eigen::Vector2d> junctions_;
  std::int64_t stamp_ = 0;  // in a drive from 0, the panorama at x has stamp x + 1
};

TEST(JunctionFilter, MakesOneJunctionOfManyPanoramas) {  // [Lu2015 4.1]
  Passage passage({{40.0, 3.0}});
  passage.drive(0.0, 80.0);
  ASSERT_THAT(passage.passed, SizeIs(1));
  EXPECT_NEAR(passage.passed[0].centre_in_odom.x(), 40.0, 0.5);
  EXPECT_NEAR(static_cast<double>(passage.passed[0].nearest_stamp_ns), 41.0, 1.0);
  EXPECT_NEAR(passage.passed[0].nearest_m, 3.5, 0.3);
  EXPECT_GT(passage.passed[0].panoramas, 10);
}

TEST(JunctionFilter, TellsOfAJunctionOnlyOnceItIsPassed) {
  Passage passage({{40.0, 0.0}});
  passage.drive(0.0, 44.0);
  EXPECT_THAT(passage.passed, IsEmpty());
  EXPECT_TRUE(passage.filter.is_pending());
  passage.drive(44.0, 60.0);
  EXPECT_THAT(passage.passed, SizeIs(1));
  EXPECT_FALSE(passage.filter.is_pending());
}

TEST(JunctionFilter, TellsTwoJunctionsApartAndTheSecondVisitOfOne) {
  Passage passage({{40.0, 0.0}, {90.0, 0.0}});
  passage.drive(0.0, 130.0);
  EXPECT_THAT(passage.passed, SizeIs(2));
  for (double x = 130.0; x > 0.0; x -= 1.0) passage.step({x, 0.0});
  EXPECT_THAT(passage.passed, SizeIs(4));
}

TEST(JunctionFilter, ReturnsASecondVisitOnlyOnceItIsPassedToo) {
  const Eigen::Vector2d junction(40.0, 0.0);
  Passage passage({junction});
  passage.drive(0.0, 66.0);  // just out of sight
  ASSERT_THAT(passage.passed, SizeIs(1));
  for (double x = 66.0; x > 10.0; x -= 1.0) {  // back on the other side; not detected for some metres on the way
    const double ahead_m = x - junction.x();
    const bool is_seen = (ahead_m >= 10.0 && ahead_m <= 13.0) || std::abs(ahead_m) <= 4.0;
    passage.add({x, 3.0}, is_seen ? std::optional(SeenJunction{junction, 3}) : std::nullopt);
    ASSERT_TRUE(ahead_m <= 0.0 || passage.passed.size() == 1) << ahead_m << " m before it";
  }
  ASSERT_THAT(passage.passed, SizeIs(2));
  EXPECT_EQ(passage.passed[1].nearest_stamp_ns, 93) << "of the first panorama at 40 m on the way back";
}

TEST(JunctionFilter, TakesNoNoticeOfWhatShowsForAMoment) {
  Passage passage({});
  passage.drive(0.0, 20.0);
  passage.add({20.0, 0.0}, SeenJunction{{22.0, 0.0}, 3});
  passage.drive(21.0, 60.0);
  EXPECT_THAT(passage.passed, IsEmpty());
}

TEST(JunctionFilter, StandingStillAtAJunctionIsOneVisit) {
  Passage passage({{40.0, 0.0}});
  passage.drive(0.0, 40.0);
  for (int i = 0; i < 500; ++i) passage.step({40.0, 0.0});
  passage.drive(40.0, 80.0);
  ASSERT_THAT(passage.passed, SizeIs(1));
  EXPECT_NEAR(passage.passed[0].centre_in_odom.x(), 40.0, 1.5);
}

}  // namespace
}  // namespace panvo::landmark_builder

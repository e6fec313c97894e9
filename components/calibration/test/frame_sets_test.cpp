// SPDX-License-Identifier: Apache-2.0
#include "live/frame_sets.hpp"

#include <gmock/gmock.h>

namespace panvo::calibration {
namespace {

using ::testing::ElementsAre;

TEST(FrameSets, AreOfOneStampInWhateverOrderFramesCome) {
  FrameSets<char> sets(2, 0);
  EXPECT_FALSE(sets.push(0, 100, 'a'));
  EXPECT_FALSE(sets.push(0, 200, 'b'));
  EXPECT_FALSE(sets.push(1, 150, 'x'));
  const auto set = sets.push(1, 200, 'y');
  ASSERT_TRUE(set);
  EXPECT_EQ(set->stamp_ns, 200);
  EXPECT_THAT(set->frames, ElementsAre('b', 'y'));
  EXPECT_FALSE(sets.push(1, 100, 'z')) << "frames older than a set are dropped";
}

TEST(FrameSets, TakeTheNearestFrameWithinTheTolerance) {
  FrameSets<char> sets(3, 6);
  EXPECT_FALSE(sets.push(0, 93, 'a'));
  EXPECT_FALSE(sets.push(0, 98, 'b'));
  EXPECT_FALSE(sets.push(2, 104, 'r'));
  const auto set = sets.push(1, 99, 'm');
  ASSERT_TRUE(set);
  EXPECT_EQ(set->stamp_ns, 98);
  EXPECT_THAT(set->frames, ElementsAre('b', 'm', 'r'));
}

TEST(FrameSets, TellHowFarApartTheNearestWere) {
  FrameSets<char> sets(2, 5);
  EXPECT_EQ(sets.closest_ns(), std::nullopt);
  sets.push(0, 100, 'a');
  EXPECT_EQ(sets.closest_ns(), std::nullopt);
  EXPECT_FALSE(sets.push(1, 120, 'x'));
  EXPECT_FALSE(sets.push(0, 132, 'b'));
  EXPECT_EQ(sets.closest_ns(), 12);
}

TEST(FrameSets, LieWithinTheToleranceFromTheFirstToTheLast) {
  FrameSets<char> sets(3, 5);
  EXPECT_FALSE(sets.push(0, 96, 'a'));
  EXPECT_FALSE(sets.push(2, 104, 'r'));
  EXPECT_FALSE(sets.push(1, 100, 'm')) << "4 from each, but 8 between them";
  EXPECT_EQ(sets.closest_ns(), 8);
  EXPECT_TRUE(sets.push(0, 101, 'b'));
}

TEST(FrameSets, HoldNoMoreThanAFewFramesThatStayAlone) {
  FrameSets<int> sets(2, 0);
  for (int i = 0; i < 100; ++i) sets.push(0, i, i);
  EXPECT_FALSE(sets.push(1, 89, 0));
  EXPECT_TRUE(sets.push(1, 90, 0));
}

}  // namespace
}  // namespace panvo::calibration

// SPDX-License-Identifier: Apache-2.0
#include "panvo/panorama_stitcher/head_sets.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace panvo::panorama_stitcher {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Optional;
using ::testing::SizeIs;
using Sets = HeadSets<int>;

constexpr Sets::Settings kSettings{.tolerance_ns = 10, .depth = 3, .missing_after = 2};

TEST(HeadSets, BringsTogetherWhatWasTakenAtOneMoment) {
  Sets sets(3, kSettings);
  EXPECT_THAT(sets.push(1, 1007, 11), IsEmpty());
  EXPECT_THAT(sets.push(0, 1000, 10), IsEmpty());
  EXPECT_THAT(sets.push(0, 2000, 20), IsEmpty());
  const auto complete = sets.push(2, 1003, 12);
  ASSERT_THAT(complete, SizeIs(1));
  EXPECT_EQ(complete[0].stamp_ns, 1000);
  EXPECT_THAT(complete[0].items, ElementsAre(Optional(10), Optional(11), Optional(12)));
}

TEST(HeadSets, DropsAndCountsWhatFindsNoSet) {
  Sets sets(2, kSettings);
  sets.push(0, 1000, 1);
  sets.push(0, 2000, 2);
  ASSERT_THAT(sets.push(1, 2005, 3), SizeIs(1));
  EXPECT_EQ(sets.unpaired(0), 1u);
  EXPECT_THAT(sets.push(1, 1001, 4), IsEmpty()) << "its set has been dropped";
  EXPECT_EQ(sets.unpaired(1), 1u);
  EXPECT_FALSE(sets.is_missing(1));
}

TEST(HeadSets, KeepsApartWhatIsFurtherApartThanTheTolerance) {
  Sets sets(2, kSettings);
  sets.push(0, 1000, 1);
  EXPECT_THAT(sets.push(1, 1011, 2), IsEmpty());
  EXPECT_THAT(sets.push(1, 2000, 3), IsEmpty());
  EXPECT_THAT(sets.push(0, 2010, 4), SizeIs(1));
}

TEST(HeadSets, GoesOnWithoutAHeadThatStaysAway) {
  Sets sets(2, kSettings);
  std::size_t complete = 0;
  for (int i = 0; i < 10; ++i) complete += sets.push(0, 1000 * i, i).size();
  EXPECT_TRUE(sets.is_missing(1));
  EXPECT_EQ(sets.unpaired(0), 2u) << "two sets without it are dropped";
  EXPECT_EQ(complete, 8u);
}

TEST(HeadSets, WaitsForAHeadThatCameBack) {
  Sets sets(2, kSettings);
  for (int i = 0; i < 10; ++i) sets.push(0, 1000 * i, i);
  EXPECT_THAT(sets.push(1, 9000, 99), IsEmpty()) << "its set has been taken without it";
  EXPECT_FALSE(sets.is_missing(1));
  EXPECT_EQ(sets.unpaired(1), 1u);
  EXPECT_THAT(sets.push(0, 10'000, 10), IsEmpty());
  const auto both = sets.push(1, 10'000, 100);
  ASSERT_THAT(both, SizeIs(1));
  EXPECT_THAT(both[0].items, ElementsAre(Optional(10), Optional(100)));
}

TEST(HeadSets, HoldsNoMoreThanItsDepth) {
  Sets sets(2, {.tolerance_ns = 10, .depth = 3, .missing_after = 1000});
  for (int i = 0; i < 100; ++i) EXPECT_THAT(sets.push(0, 1000 * i, i), IsEmpty());
  EXPECT_EQ(sets.unpaired(0), 97u);
}

/// Two heads with ten images per second.
class HeadSetsWhoseClockIsSetBack : public testing::Test {
 protected:
  static constexpr std::int64_t kInterval_ns = 100'000'000;
  static constexpr int kBack = 6000;  // intervals

  void take(int first, int end) {
    for (int i = first; i < end; ++i) {
      for (const std::size_t head : {0U, 1U}) push(head, i);
    }
  }
  void push(std::size_t head, int i) {
    for (const auto& set : sets.push(head, i * kInterval_ns, i)) {
      if (set.items[0] == set.items[1]) complete.push_back(*set.items[0]);
    }
  }

  Sets sets{2, {}};
  std::vector<int> complete;  // with both heads
};

TEST_F(HeadSetsWhoseClockIsSetBack, GoOnWithTheNewTime) {
  take(10'000, 10'020);
  sets.push(0, 10'020 * kInterval_ns, 10'020);  // waits for the other head
  complete.clear();
  take(10'020 - kBack, 10'030 - kBack);
  EXPECT_THAT(complete, ElementsAre(4024, 4025, 4026, 4027, 4028, 4029)) << "from the fifth on";
  EXPECT_EQ(sets.unpaired(0), 5u);
  EXPECT_EQ(sets.unpaired(1), 4u);
}

TEST_F(HeadSetsWhoseClockIsSetBack, GoOnIfTheOtherHeadsClockFollowsLater) {
  take(10'000, 10'020);
  complete.clear();
  for (int i = 0; i < 30; ++i) {
    push(0, 10'020 - kBack + i);
    push(1, 10'020 - (i < 20 ? 0 : kBack) + i);
  }
  EXPECT_THAT(complete, ElementsAre(4045, 4046, 4047, 4048, 4049)) << "when that is certain";
  EXPECT_FALSE(sets.is_missing(0));
  EXPECT_FALSE(sets.is_missing(1));
}

TEST_F(HeadSetsWhoseClockIsSetBack, DropSingleLateImages) {
  for (int i = 0; i < 20; ++i) {
    take(10'000 + i, 10'001 + i);
    take(10'000 - kBack + i, 10'001 - kBack + i);
  }
  EXPECT_THAT(complete, SizeIs(20));
  EXPECT_THAT(complete, testing::Each(testing::Ge(10'000)));
  EXPECT_EQ(sets.unpaired(0), 20u);
}

TEST(HeadSets, RefusesSettingsThatMakeNoSense) {
  EXPECT_THROW(Sets(0, kSettings), std::invalid_argument);
  EXPECT_THROW(Sets(2, {.tolerance_ns = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::panorama_stitcher

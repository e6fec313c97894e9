// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/stamp_sequence.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

namespace panvo::vision {
namespace {

using ::testing::ElementsAre;
using enum StampOrder;

/// Of each of these stamps, in ms.
std::vector<StampOrder> orders_of(const std::vector<std::int64_t>& stamps_ms, StampSequence stamps = {}) {
  std::vector<StampOrder> orders(stamps_ms.size());
  std::transform(stamps_ms.begin(), stamps_ms.end(), orders.begin(),
                 [&](std::int64_t stamp_ms) { return stamps.add(1'000'000 * stamp_ms); });
  return orders;
}

TEST(StampSequence, TellsWhatIsNotLater) {
  EXPECT_THAT(orders_of({700, 800, 800, 750, 801}), ElementsAre(kLater, kLater, kNotLater, kNotLater, kLater));
}

TEST(StampSequence, TellsAClockThatWasSetBackAndGoesOnWithTheNewTime) {
  EXPECT_THAT(orders_of({9000, 100, 200, 300, 400, 500, 600, 600}),
              ElementsAre(kLater, kNotLater, kNotLater, kNotLater, kNotLater, kSetBack, kLater, kNotLater));
}

TEST(StampSequence, TellsItAfterFewerStampsIfFewerAreAskedFor) {
  const StampSequence two(2);
  EXPECT_THAT(orders_of({9000, 100, 200, 300}, two), ElementsAre(kLater, kNotLater, kSetBack, kLater));
  EXPECT_THAT(orders_of({9000, 100, 9000, 100, 9100}, two),
              ElementsAre(kLater, kNotLater, kNotLater, kNotLater, kLater))
      << "single ones";
}

TEST(StampSequence, SaysTheTimeThatCounts) {
  StampSequence stamps(2);
  EXPECT_FALSE(stamps.latest_ns());
  for (const std::int64_t stamp_ns : {9'000'000'000LL, 100'000'000LL}) stamps.add(stamp_ns);
  EXPECT_EQ(stamps.latest_ns(), 9'000'000'000);
  stamps.add(200'000'000);
  EXPECT_EQ(stamps.latest_ns(), 200'000'000);
}

TEST(StampSequence, KeepsTheTimeIfSomeSingleStampsAreLate) {
  StampSequence stamps;
  for (std::int64_t i = 0; i < 20; ++i) {
    EXPECT_EQ(stamps.add((10 + i) * 1'000'000'000), kLater);
    EXPECT_EQ(stamps.add(i * 1'000'000'000), kNotLater) << i;
  }
}

TEST(StampSequence, TakesDisorderForNoSetClock) {
  EXPECT_THAT(orders_of({9000, 8600, 8610, 8620, 8630, 8640}),
              ElementsAre(kLater, kNotLater, kNotLater, kNotLater, kNotLater, kNotLater))
      << "less than half a second back";
  EXPECT_THAT(orders_of({9000, 500, 400, 300, 200, 100}),
              ElementsAre(kLater, kNotLater, kNotLater, kNotLater, kNotLater, kNotLater))
      << "they do not increase";
}

}  // namespace
}  // namespace panvo::vision

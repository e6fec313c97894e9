// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/stamp_pairing.hpp"

#include <gmock/gmock.h>

namespace panvo::camera_stream {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Pairing = StampPairing<int>;

TEST(StampPairing, GivesAllTheStampOfTheFirstCamera) {
  Pairing pairing({.streams = 2, .tolerance_ns = 5});
  EXPECT_THAT(pairing.push(1, 103, 11), IsEmpty());
  const auto sets = pairing.push(0, 100, 10);
  ASSERT_THAT(sets, SizeIs(1));
  EXPECT_EQ(sets[0].stamp_ns, 100);
  EXPECT_THAT(sets[0].items, ElementsAre(10, 11));
}

TEST(StampPairing, PairsAtTheToleranceAndNotBeyond) {
  Pairing at({.streams = 2, .tolerance_ns = 5});
  at.push(0, 100, 0);
  EXPECT_THAT(at.push(1, 105, 1), SizeIs(1));
  Pairing beyond({.streams = 2, .tolerance_ns = 5});
  beyond.push(0, 100, 0);
  EXPECT_THAT(beyond.push(1, 106, 1), IsEmpty());
  EXPECT_EQ(beyond.unpaired(0), 1u);
  EXPECT_EQ(beyond.unpaired(1), 0u);
}

TEST(StampPairing, DropsAHalfWhosePartnerWasLostAndGoesOn) {
  Pairing pairing({.streams = 2, .tolerance_ns = 5});
  for (const std::int64_t stamp : {100, 200, 300}) pairing.push(0, stamp, static_cast<int>(stamp));
  EXPECT_THAT(pairing.push(1, 101, 0), SizeIs(1));
  const auto sets = pairing.push(1, 301, 0);  // the second camera lost the frame at 200
  ASSERT_THAT(sets, SizeIs(1));
  EXPECT_EQ(sets[0].stamp_ns, 300);
  EXPECT_EQ(pairing.unpaired(0), 1u);
  EXPECT_EQ(pairing.unpaired(1), 0u);
}

TEST(StampPairing, KeepsFewFramesOfACameraWhoseFellowIsSilent) {
  Pairing pairing({.streams = 2, .tolerance_ns = 5, .depth = 3});
  for (int i = 0; i < 100; ++i) pairing.push(0, i * 100, i);
  EXPECT_EQ(pairing.unpaired(0), 97u);
  const auto sets = pairing.push(1, 9901, -1);
  ASSERT_THAT(sets, SizeIs(1));
  EXPECT_THAT(sets[0].items, ElementsAre(99, -1));
  EXPECT_EQ(pairing.unpaired(0), 99u);
}

TEST(StampPairing, BringsSixHeadsTogetherInWhateverOrderTheyCome) {
  Pairing pairing({.streams = 6, .tolerance_ns = 5});
  for (const std::size_t head : {3U, 1U, 5U, 0U, 4U})
    EXPECT_THAT(pairing.push(head, 100 + static_cast<int>(head), static_cast<int>(head)), IsEmpty());
  const auto sets = pairing.push(2, 102, 2);
  ASSERT_THAT(sets, SizeIs(1));
  EXPECT_EQ(sets[0].stamp_ns, 100);
  EXPECT_THAT(sets[0].items, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(StampPairing, GivesSeveralSetsWhenALateCameraCatchesUp) {
  Pairing pairing({.streams = 3, .tolerance_ns = 5});
  for (const std::size_t stream : {0U, 1U}) {
    for (int i = 1; i <= 3; ++i) pairing.push(stream, i * 100, i);
  }
  EXPECT_THAT(pairing.push(2, 101, 1), SizeIs(1));
  EXPECT_THAT(pairing.push(2, 201, 2), SizeIs(1));
  EXPECT_THAT(pairing.push(2, 301, 3), SizeIs(1));
}

TEST(StampPairing, CountsEveryFrameOnce) {
  // Each camera loses frames periodically: every pushed frame is in a set, dropped or waiting.
  Pairing pairing({.streams = 2, .tolerance_ns = 5, .depth = 4});
  std::uint64_t pushed[2] = {0, 0}, sets = 0;
  for (int i = 0; i < 1000; ++i) {
    for (const int stream : {0, 1}) {
      if (i % (stream == 0 ? 7 : 11) == 3) continue;
      ++pushed[stream];
      sets += pairing.push(static_cast<std::size_t>(stream), i * 100 + stream * 2, i).size();
    }
  }
  EXPECT_EQ(pushed[0] - pairing.unpaired(0), sets);
  EXPECT_EQ(pushed[1] - pairing.unpaired(1), sets);
  EXPECT_EQ(sets, 1000u - 143u - 91u + 13u);  // lost by the first, by the second, by both (subtracted twice)
}

TEST(StampPairing, RefusesSettingsThatMakeNoSense) {
  EXPECT_THROW(Pairing({.streams = 0}), std::invalid_argument);
  EXPECT_THROW(Pairing({.streams = 2, .tolerance_ns = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::camera_stream

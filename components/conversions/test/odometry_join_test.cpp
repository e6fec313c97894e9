// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/odometry_join.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kFrame_ns = 40'000'000;

struct Join {
  OdometryJoin join;
  std::vector<std::string> out;  // "3+": frame 3, reliable; "3-": unreliable; "3?": unknown

  void odometry(int frame, std::int64_t now_ns = 0, bool is_told = true) {
    nav_msgs::msg::Odometry message;
    message.header().stamp(conversions::to_stamp(frame * kFrame_ns));
    join.add(std::make_shared<const nav_msgs::msg::Odometry>(message), now_ns);
    take(now_ns, is_told);
  }
  void quality(int frame, bool is_reliable) {
    panvo_msgs::msg::OdometryQuality message;
    message.header().stamp(conversions::to_stamp(frame * kFrame_ns));
    message.reliable(is_reliable);
    message.inlier_ratio(1.0);
    join.add(message);
    take(0, true);
  }
  void take(std::int64_t now_ns, bool is_told) {
    while (const auto next = join.next(now_ns, is_told)) {
      const auto frame = conversions::stamp_ns(*next->odometry) / kFrame_ns;
      out.push_back(std::to_string(frame) + (next->lacks_quality ? "?" : next->quality.is_reliable ? "+" : "-"));
    }
  }
};

TEST(OdometryJoin, GivesEachOdometryItsOwnQualityInWhateverOrderTheyArrive) {
  // All interleavings of three odometry and three quality messages, each in their own order.
  std::string mixed = "oooqqq";
  std::sort(mixed.begin(), mixed.end());
  do {
    Join join;
    int odometry = 0, quality = 0;
    for (const char kind : mixed) {
      if (kind == 'o') {
        join.odometry(++odometry);
      } else {
        ++quality;
        join.quality(quality, quality != 2);
      }
    }
    EXPECT_THAT(join.out, ElementsAre("1+", "2-", "3+")) << mixed;
  } while (std::next_permutation(mixed.begin(), mixed.end()));
}

TEST(OdometryJoin, KeepsNoOdometryWaitingWhereNobodyTellsTheQuality) {
  Join join;
  join.odometry(1, 0, false);
  join.odometry(2, 0, false);
  EXPECT_THAT(join.out, ElementsAre("1+", "2+"));
}

TEST(OdometryJoin, WaitsNoLongerWhenTheQualityWasLost) {
  Join join;
  join.odometry(1);
  EXPECT_TRUE(join.out.empty());
  join.odometry(2);
  join.quality(2, true);
  EXPECT_THAT(join.out, ElementsAre("1?", "2+"));
}

TEST(OdometryJoin, WaitsABoundedTime) {
  Join join;
  join.odometry(1);
  join.take(190'000'000, true);
  EXPECT_TRUE(join.out.empty());
  join.take(210'000'000, true);
  EXPECT_THAT(join.out, ElementsAre("1?"));
}

TEST(OdometryJoin, HoldsABoundedNumberAndGivesUpOnOneWhoSaysNothing) {
  Join join;
  for (int i = 0; i < 11; ++i) join.odometry(i);
  EXPECT_EQ(join.out.size(), 1U);
  for (int i = 11; i < 40; ++i) join.odometry(i);
  EXPECT_EQ(join.out.size(), 40U) << "quality is no longer expected";
  join.quality(40, false);
  join.odometry(40);
  EXPECT_EQ(join.out.back(), "40-") << "but used when it returns";
}

}  // namespace
}  // namespace panvo::conversions

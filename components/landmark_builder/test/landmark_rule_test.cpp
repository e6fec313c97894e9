// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/landmark_rule.hpp"

#include <gtest/gtest.h>

namespace panvo::landmark_builder {
namespace {

constexpr std::int64_t kBegin_ns = 1'000'000'000;

void put(landmarks::MapReplica& map, std::uint32_t id, const Eigen::Vector2d& position,
         std::int64_t stamp_ns = kBegin_ns) {
  landmarks::PanoramicLandmark landmark;
  landmark.id = id;
  landmark.stamp_ns = stamp_ns;
  landmark.map_from_base.translation().head<2>() = position;
  map.add(landmark);
}

TEST(LandmarkRule, TakesNoneBesideAnother) {  // [Lu2015 4.1]
  LandmarkRule rule({});
  landmarks::MapReplica map;
  EXPECT_TRUE(rule.takes(map, {0.0, 0.0}, 0.0));
  put(map, 1, {0.0, 0.0});
  EXPECT_FALSE(rule.takes(map, {5.0, -5.0}, 300.0));
  EXPECT_TRUE(rule.takes(map, {50.0, 0.0}, 300.0));
}

TEST(LandmarkRule, TakesNoneWhereOneWasRecognisedThoughThePositionHasDrifted) {
  LandmarkRule rule({});
  landmarks::MapReplica map;
  put(map, 1, {0.0, 0.0});
  rule.recognised(400.0);
  EXPECT_FALSE(rule.takes(map, {60.0, 0.0}, 395.0));
  EXPECT_FALSE(rule.takes(map, {60.0, 0.0}, 410.0));
  EXPECT_TRUE(rule.takes(map, {60.0, 0.0}, 440.0));
}

TEST(LandmarkRule, TakesAnotherAppearanceOfAPlaceThatLooksDifferentToday) {
  LandmarkRule rule({});
  landmarks::MapReplica map;
  rule.begin(kBegin_ns);
  put(map, 1, {0.0, 0.0});
  put(map, 2, {200.0, 0.0}, kBegin_ns - 1);
  EXPECT_FALSE(rule.takes(map, {200.0, 1.0}, 200.0)) << "nothing was recognised: the position may be wrong";
  rule.recognised(10.0);
  EXPECT_FALSE(rule.takes(map, {0.0, 1.0}, 200.0)) << "landmark 1 is of this run";
  EXPECT_TRUE(rule.takes(map, {200.0, 1.0}, 200.0));
  EXPECT_FALSE(rule.takes(map, {200.0, 1.0}, 400.0)) << "too long ago";
  for (std::uint32_t id = 3; id <= 5; ++id) {
    EXPECT_TRUE(rule.takes(map, {200.0, 1.0}, 200.0));
    put(map, id, {201.0, 0.0}, kBegin_ns - 1);
  }
  EXPECT_FALSE(rule.takes(map, {200.0, 1.0}, 200.0)) << "four are enough";
}

TEST(LandmarkRule, IsDueAfterALongWayWithoutOne) {  // [Lu2015 4.1]
  LandmarkRule rule({});
  landmarks::MapReplica map;
  put(map, 1, {0.0, 0.0});
  EXPECT_FALSE(rule.is_due(map, 99.0));
  EXPECT_TRUE(rule.is_due(map, 100.0));
  rule.taken(100.0);
  EXPECT_FALSE(rule.is_due(map, 150.0));
  rule.recognised(160.0);
  EXPECT_FALSE(rule.is_due(map, 240.0));
  EXPECT_TRUE(rule.is_due(map, 260.0));
  EXPECT_FALSE(LandmarkRule({.max_spacing_m = 0.0}).is_due(map, 1e6));
}

TEST(LandmarkRule, TakesTheFirstWhereANewMapBegins) {
  LandmarkRule rule({});
  landmarks::MapReplica map;
  EXPECT_FALSE(rule.is_due(map, 3.9));
  EXPECT_TRUE(rule.is_due(map, 4.0));
  put(map, 1, {4.0, 0.0});
  rule.taken(4.0);
  EXPECT_FALSE(rule.is_due(map, 8.0));
  put(map, 9, {300.0, 0.0});
  EXPECT_FALSE(LandmarkRule({}).is_due(map, 4.0)) << "of a known map";
}

}  // namespace
}  // namespace panvo::landmark_builder

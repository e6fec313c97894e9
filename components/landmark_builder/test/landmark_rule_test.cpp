// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/landmark_rule.hpp"

#include <gtest/gtest.h>

namespace panvo::landmark_builder {
namespace {

TEST(LandmarkRule, TakesNoneBesideAnother) {  // [Lu2015 4.1]
  LandmarkRule rule({});
  EXPECT_TRUE(rule.takes({0.0, 0.0}, 0.0));
  rule.set_landmark(rule.next_id(), {0.0, 0.0});
  EXPECT_FALSE(rule.takes({5.0, -5.0}, 300.0));
  EXPECT_TRUE(rule.takes({50.0, 0.0}, 300.0));
}

TEST(LandmarkRule, TakesNoneWhereOneWasRecognisedThoughThePositionHasDrifted) {
  LandmarkRule rule({});
  rule.set_landmark(1, {0.0, 0.0});
  rule.recognised(400.0);
  EXPECT_FALSE(rule.takes({60.0, 0.0}, 395.0));
  EXPECT_FALSE(rule.takes({60.0, 0.0}, 410.0));
  EXPECT_TRUE(rule.takes({60.0, 0.0}, 440.0));
}

TEST(LandmarkRule, TakesAnotherAppearanceOfAPlaceThatLooksDifferentToday) {
  LandmarkRule rule({});
  rule.set_landmark(1, {0.0, 0.0});
  rule.set_landmark(2, {200.0, 0.0});
  rule.set_earlier(2);
  EXPECT_FALSE(rule.takes({200.0, 1.0}, 200.0)) << "nothing was recognised: the position may be wrong";
  rule.recognised(10.0);
  EXPECT_FALSE(rule.takes({0.0, 1.0}, 200.0)) << "landmark 1 is of this run";
  EXPECT_TRUE(rule.takes({200.0, 1.0}, 200.0));
  EXPECT_FALSE(rule.takes({200.0, 1.0}, 400.0)) << "too long ago";
  for (std::uint32_t id = 3; id <= 5; ++id) {
    EXPECT_TRUE(rule.takes({200.0, 1.0}, 200.0));
    rule.set_landmark(id, {201.0, 0.0});
    rule.set_earlier(id);
  }
  EXPECT_FALSE(rule.takes({200.0, 1.0}, 200.0)) << "four are enough";
}

TEST(LandmarkRule, IsDueAfterALongWayWithoutOne) {  // [Lu2015 4.1]
  LandmarkRule rule({});
  rule.set_landmark(1, {0.0, 0.0});
  EXPECT_FALSE(rule.is_due(99.0));
  EXPECT_TRUE(rule.is_due(100.0));
  rule.taken(100.0);
  EXPECT_FALSE(rule.is_due(150.0));
  rule.recognised(160.0);
  EXPECT_FALSE(rule.is_due(240.0));
  EXPECT_TRUE(rule.is_due(260.0));
  EXPECT_FALSE(LandmarkRule({.max_spacing_m = 0.0}).is_due(1e6));
}

TEST(LandmarkRule, TakesTheFirstWhereANewMapBegins) {
  LandmarkRule rule({});
  EXPECT_FALSE(rule.is_due(3.9));
  EXPECT_TRUE(rule.is_due(4.0));
  rule.set_landmark(rule.next_id(), {4.0, 0.0});
  rule.taken(4.0);
  EXPECT_FALSE(rule.is_due(8.0));
  LandmarkRule of_a_known_place({});
  of_a_known_place.set_landmark(9, {300.0, 0.0});
  EXPECT_FALSE(of_a_known_place.is_due(4.0));
}

TEST(LandmarkRule, NumbersOnFromThoseThatAreThere) {
  LandmarkRule rule({});
  EXPECT_EQ(rule.next_id(), 1U);
  rule.set_landmark(7, {0.0, 0.0});
  EXPECT_EQ(rule.next_id(), 8U);
}

}  // namespace
}  // namespace panvo::landmark_builder

// SPDX-License-Identifier: Apache-2.0
#include "store_changes.hpp"

#include <gtest/gtest.h>

#include "made_up_landmark.hpp"

namespace panvo::landmarks {
namespace {

NewLandmark added(std::uint32_t id) { return {test::made_up_landmark(id), test::made_up_settings(), std::nullopt}; }

MovedLandmarks moved(std::vector<std::pair<std::uint32_t, double>> to_x) {
  MovedLandmarks change;
  for (const auto& [id, x] : to_x) {
    change.poses.push_back({id});
    change.poses.back().map_from_base.translation().x() = x;
  }
  return change;
}

TEST(PendingChanges, ComeInOrder) {
  PendingChanges pending(10);
  EXPECT_EQ(pending.take(), nullptr);
  pending.push(added(1));
  pending.push(RemovedLandmark{4});
  EXPECT_EQ(std::get<NewLandmark>(*pending.take()).landmark.id, 1U);
  EXPECT_EQ(pending.size(), 2U) << "the one that is being made counts";
  pending.done();
  EXPECT_EQ(std::get<RemovedLandmark>(*pending.take()).id, 4U);
  pending.done();
  EXPECT_EQ(pending.size(), 0U);
}

TEST(PendingChanges, AreRefusedAndCountedWithoutRoom) {
  PendingChanges pending(3);
  EXPECT_TRUE(pending.push(added(1)));
  EXPECT_TRUE(pending.push(PassedLandmarks{{{1}, {2}}}));
  EXPECT_FALSE(pending.push(PassedLandmarks{{{1}}}));
  EXPECT_FALSE(pending.push(added(2)));
  EXPECT_EQ(pending.refused(), 2U);
  EXPECT_TRUE(pending.push(moved({{1, 2.0}}))) << "poses take no room";
  pending.take();
  EXPECT_TRUE(pending.push(added(2)));
  EXPECT_EQ(pending.refused(), 2U);
}

TEST(PendingChanges, MoveALandmarkOnceAndAfterItIsThere) {
  PendingChanges pending(10);
  pending.push(moved({{1, 1.0}, {2, 2.0}}));
  pending.push(added(5));
  pending.push(moved({{2, 3.0}, {5, 4.0}}));
  EXPECT_EQ(pending.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<NewLandmark>(*pending.take()));
  const auto poses = std::get<MovedLandmarks>(*pending.take()).poses;
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].map_from_base.translation().x(), 1.0);
  EXPECT_EQ(poses[1].map_from_base.translation().x(), 3.0);
  EXPECT_EQ(poses[2].map_from_base.translation().x(), 4.0);
}

TEST(PendingChanges, LeaveThoseThatAreBeingMadeAlone) {
  PendingChanges pending(10);
  pending.push(moved({{1, 1.0}}));
  pending.push(PassedLandmarks{{{1}}});
  const auto first = pending.take();
  pending.push(moved({{1, 2.0}}));
  EXPECT_EQ(std::get<MovedLandmarks>(*first).poses.front().map_from_base.translation().x(), 1.0);
  const auto second = pending.take();
  pending.push(PassedLandmarks{{{2}}});
  EXPECT_EQ(std::get<PassedLandmarks>(*second).passes.size(), 1U);
}

}  // namespace
}  // namespace panvo::landmarks

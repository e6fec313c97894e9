// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/common_frame.hpp"

#include <gtest/gtest.h>

#include "made_up_maps.hpp"

namespace panvo::fleet {
namespace {

constexpr double kGate = 22.5;

/// Poses of the maps' origins in the world.
Eigen::Isometry3d world_from(MapId map) {
  const auto i = static_cast<double>(map);
  return flat(10.0 * i, -3.0 * i, 0.5 * i);
}

/// Present robots, each with its own frame.
std::map<MapId, MapId> present(const std::vector<MapId>& maps) {
  std::map<MapId, MapId> used;
  for (const auto map : maps) used[map] = map;
  return used;
}

JoinedPair joined(MapId a, MapId b, int agreeing = 5, const Eigen::Isometry3d& error = Eigen::Isometry3d::Identity()) {
  return {a, b, {world_from(a).inverse() * world_from(b) * error, covariance_of(0.1, 0.01)}, agreeing};
}

TEST(CommonFrame, OfARobotAloneIsItsOwn) {
  const auto frame = common_frame(5, {}, present({5}), kGate);
  EXPECT_EQ(frame.map, 5U);
  EXPECT_TRUE(frame.common_from_own.a_from_b.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(frame.own_from.empty());
}

TEST(CommonFrame, IsThatOfTheSmallestJoinedMap) {
  const std::vector<JoinedPair> joins{joined(4, 9), joined(9, 6)};
  for (const MapId own : {4U, 6U, 9U}) {
    const auto frame = common_frame(own, joins, present({2, 4, 6, 9}), kGate);
    EXPECT_EQ(frame.map, 4U) << "map 2 is not joined";
    EXPECT_EQ(frame.own_from.size(), 2U);
    const Eigen::Isometry3d expected = world_from(4).inverse() * world_from(own);
    EXPECT_LT(vision::pose_error(frame.common_from_own.a_from_b, expected).norm(), 1e-9) << own;
  }
}

TEST(CommonFrame, IsLessCertainTheMoreJoinsLieBetween) {
  const std::vector<JoinedPair> joins{joined(4, 9), joined(9, 6)};
  const auto near = common_frame(9, joins, present({4, 6, 9}), kGate).common_from_own;
  const auto far = common_frame(6, joins, present({4, 6, 9}), kGate).common_from_own;
  EXPECT_GT(vision::horizontal_sigma(far.covariance), vision::horizontal_sigma(near.covariance));
}

TEST(CommonFrame, StaysWhenARobotWithASmallerIdComes) {
  const std::vector<JoinedPair> joins{joined(6, 9), joined(4, 9)};
  EXPECT_EQ(common_frame(9, joins, {{6, 6}, {9, 6}, {4, 4}}, kGate).map, 6U);
  EXPECT_EQ(common_frame(4, joins, {{6, 6}, {9, 6}, {4, 4}}, kGate).map, 6U) << "it takes over the frame of the others";
  EXPECT_EQ(common_frame(9, joins, {{9, 6}, {4, 4}}, kGate).map, 4U) << "the robot of map 6 left";
  EXPECT_EQ(common_frame(9, {joined(4, 9)}, {{6, 6}, {9, 6}, {4, 4}}, kGate).map, 4U) << "map 6 is not joined any more";
}

TEST(CommonFrame, IsNotThatOfARobotThatLeft) {
  const auto frame = common_frame(9, {joined(4, 9), joined(9, 6)}, present({6, 9}), kGate);
  EXPECT_EQ(frame.map, 6U);
  EXPECT_EQ(frame.own_from.size(), 2U) << "its map is still joined";
}

TEST(CommonFrame, LeavesOutTheWeakestJoinOfALoopThatContradictsItself) {
  const auto wrong = flat(8.0, 0.0, 0.3);
  const auto frame =
      common_frame(6, {joined(4, 6, 3, wrong), joined(4, 9, 7), joined(6, 9, 6)}, present({4, 6, 9}), kGate);
  ASSERT_EQ(frame.contradictory.size(), 1U);
  EXPECT_EQ(frame.contradictory[0], (std::pair<MapId, MapId>(4, 6)));
  const Eigen::Isometry3d expected = world_from(4).inverse() * world_from(6);
  EXPECT_LT(vision::pose_error(frame.common_from_own.a_from_b, expected).norm(), 1e-9);
  EXPECT_TRUE(
      common_frame(6, {joined(4, 6), joined(4, 9), joined(6, 9)}, present({4, 6, 9}), kGate).contradictory.empty());
}

}  // namespace
}  // namespace panvo::fleet

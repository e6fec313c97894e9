// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/map_replica.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace panvo::landmarks {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

LandmarkPose pose_at(std::uint32_t id, double x, double variance = 0.01) {
  return {id, Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)), variance * Eigen::Matrix<double, 6, 6>::Identity()};
}

PanoramicLandmark landmark_at(std::uint32_t id, double x, std::int64_t stamp_ns = 100) {
  PanoramicLandmark landmark;
  landmark.id = id;
  landmark.stamp_ns = stamp_ns;
  landmark.map_from_base = pose_at(id, x).map_from_base;
  landmark.covariance = pose_at(id, x).covariance;
  return landmark;
}

double x_of(const MapReplica& map, std::uint32_t id) { return map.pose(id).map_from_base.translation().x(); }

TEST(MapReplica, IsTheSameInWhicheverOrderTheMessagesArrive) {
  auto first = landmark_at(1, 5.0), second = landmark_at(1, 5.0);
  MapReplica one, other;
  EXPECT_TRUE(one.add(first));
  EXPECT_THAT(one.move({pose_at(1, 7.0)}), SizeIs(1));
  EXPECT_THAT(other.move({pose_at(1, 7.0)}), SizeIs(1));
  EXPECT_FALSE(other.places().at(1).stamp_ns) << "the landmark is not there yet";
  EXPECT_FALSE(other.add(second));
  EXPECT_EQ(second.map_from_base.translation().x(), 7.0);
  for (const auto* map : {&one, &other}) {
    ASSERT_THAT(map->places(), SizeIs(1));
    EXPECT_EQ(x_of(*map, 1), 7.0);
    EXPECT_EQ(map->places().at(1).stamp_ns, 100);
  }
}

TEST(MapReplica, KeepsTheOwnersPoseOfALandmarkThatArrivesAgain) {
  MapReplica map;
  map.move({pose_at(1, 7.0)});
  auto again = landmark_at(1, 5.0);
  EXPECT_FALSE(map.add(again));
  EXPECT_EQ(x_of(map, 1), 7.0);
}

TEST(MapReplica, TakesANewPoseOfALandmarkThatNobodyOwns) {
  MapReplica map;
  auto landmark = landmark_at(1, 5.0), moved = landmark_at(1, 6.0);
  map.add(landmark);
  map.move({pose_at(2, 0.0)});
  EXPECT_TRUE(map.add(moved));
  EXPECT_EQ(x_of(map, 1), 6.0);
}

TEST(MapReplica, TellsWhichPosesAreNew) {
  MapReplica map;
  map.move({pose_at(1, 1.0), pose_at(2, 2.0), pose_at(3, 3.0)});
  const auto moved = map.move({pose_at(1, 1.0), pose_at(2, 2.5), pose_at(3, 3.0, 0.02)});
  ASSERT_THAT(moved, SizeIs(2));
  EXPECT_EQ(moved[0].id, 2U);
  EXPECT_EQ(moved[1].id, 3U) << "its covariance";
  EXPECT_THAT(map.move({pose_at(1, 1.0 + 1e-12)}), IsEmpty()) << "rounded";
}

TEST(MapReplica, MakesGoodALostMessageWithTheNext) {
  MapReplica all, some;
  for (const double x : {1.0, 2.0, 3.0}) {
    all.move({pose_at(1, x), pose_at(2, 10.0 * x)});
    if (x != 2.0) some.move({pose_at(1, x), pose_at(2, 10.0 * x)});
  }
  for (const std::uint32_t id : {1U, 2U}) EXPECT_EQ(x_of(all, id), x_of(some, id));
}

TEST(MapReplica, ForgetsThePoseOfALandmarkThatNeverCameOnceTheOwnerDoes) {
  MapReplica map;
  auto landmark = landmark_at(1, 5.0);
  map.add(landmark);
  map.move({pose_at(1, 6.0), pose_at(2, 0.0)});
  map.move({pose_at(3, 0.0)});
  ASSERT_THAT(map.places(), SizeIs(2));
  EXPECT_EQ(x_of(map, 1), 6.0);
  EXPECT_FALSE(map.places().contains(2));
}

TEST(MapReplica, TellsALandmarkFromAnotherOneOfItsIdByThePanorama) {
  MapReplica map;
  map.move({pose_at(1, 7.0), pose_at(2, 8.0)});
  auto landmark = landmark_at(1, 5.0, 100);
  EXPECT_FALSE(map.is_other(landmark)) << "only its pose is known";
  map.add(landmark);
  EXPECT_FALSE(map.is_other(landmark_at(1, 9.0, 100)));
  EXPECT_TRUE(map.is_other(landmark_at(1, 5.0, 101)));
  EXPECT_FALSE(map.is_other(landmark_at(3, 5.0, 101)));
}

TEST(MapReplica, NumbersOnFromAllThatAreThere) {
  MapReplica map;
  EXPECT_EQ(map.next_id(), 1U);
  auto landmark = landmark_at(7, 0.0);
  map.add(landmark);
  EXPECT_EQ(map.next_id(), 8U);
  map.move({pose_at(11, 0.0)});
  EXPECT_EQ(map.next_id(), 12U) << "a landmark of which only the pose arrived";
}

}  // namespace
}  // namespace panvo::landmarks

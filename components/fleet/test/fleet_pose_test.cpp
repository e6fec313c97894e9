// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/fleet_pose.hpp"

#include <gtest/gtest.h>

#include "made_up_maps.hpp"

namespace panvo::fleet {
namespace {

const JoinParameters kNoDrift{.drift_ratio = 0.0, .drift_deg_per_m = 0.0};

/// Map a loses its way between its first and its last places: all from the sixth on are off, and say so. Map b does not.
struct DriftedMap : TwoMaps {
  DriftedMap() {
    std::vector<landmarks::LandmarkPose> drifted;
    for (std::uint32_t id = 6; id <= kPlaces; ++id) {
      drifted.push_back({id, a_from_world * world_drift * world_place(id), covariance_of(2.0, 0.001)});
    }
    a.move(drifted, 0.0, 0.0);
  }
  JoinedMaps joined() const { return {&a, &b, decide(a, b, kNoDrift).agreed}; }
  /// The vehicle of a beside its last place, as its own map has it.
  PoseSample last() const {
    return {1, a_from_world * world_drift * flat(121.0, 1.0, 0.1), covariance_of(2.0, 0.001), 0.0};
  }
  double error_of(const FleetPose& pose) const {
    return vision::pose_error(pose.common_from_base, a_from_world * flat(121.0, 1.0, 0.1)).norm();
  }
  const Eigen::Isometry3d world_drift = flat(1.0, 2.0, 0.0);
};

TEST(FleetPose, GoesThroughTheMapOfAnotherThatIsMoreCertain) {
  DriftedMap maps;
  for (const std::uint32_t id : {1U, 2U, 3U, 10U, 11U, 12U}) maps.a_sees(id, id);
  const auto pose = most_certain_pose(maps.a, maps.a, maps.last(), {maps.joined()}, kNoDrift);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->bridges, 2);
  EXPECT_LT(maps.error_of(*pose), 0.01);
  EXPECT_LT(vision::horizontal_sigma(pose->covariance), 1.0);
}

TEST(FleetPose, StaysInTheOwnMapWithoutAWayBack) {
  DriftedMap maps;
  for (const std::uint32_t id : {1U, 2U, 3U}) maps.a_sees(id, id);
  const auto pose = most_certain_pose(maps.a, maps.a, maps.last(), {maps.joined()}, kNoDrift);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->bridges, 0);
  EXPECT_TRUE(pose->common_from_base.isApprox(maps.last().map_from_base));
}

TEST(FleetPose, IsThatOfTheBridgeForARobotOfAnotherMap) {
  TwoMaps maps;
  for (const std::uint32_t id : {1U, 2U, 3U}) maps.a_sees(id, id);
  const JoinedMaps joined{&maps.a, &maps.b, decide(maps.a, maps.b, {}).agreed};
  const PoseSample in_b{1, maps.b_from_world * flat(33, 1, 0.2), covariance_of(0.1, 0.01), 0.0};
  const auto pose = most_certain_pose(maps.a, maps.b, in_b, {joined}, {});
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->bridges, 1);
  EXPECT_LT(vision::pose_error(pose->common_from_base, maps.a_from_world * flat(33, 1, 0.2)).norm(), 1e-6);
}

TEST(FleetPose, DoesNotExistWithoutABridge) {
  TwoMaps maps;
  EXPECT_FALSE(most_certain_pose(maps.a, maps.b, {}, {}, {}));
}

TEST(FleetPose, IsTheOwnPoseOfARobotAlone) {
  TwoMaps maps;
  const PoseSample in_a{1, flat(4, 5, 1), covariance_of(0.3, 0.01), 0.0};
  const auto pose = most_certain_pose(maps.a, maps.a, in_a, {}, {});
  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->common_from_base.isApprox(in_a.map_from_base));
  EXPECT_TRUE(pose->covariance.isApprox(in_a.covariance));
}

TEST(Bridges, ShareNoSightings) {
  TwoMaps maps;
  for (std::uint32_t id = 1; id <= 12; ++id) maps.a_sees(id, id);
  const JoinedMaps joined{&maps.a, &maps.b, cross_sightings(maps.a, maps.b)};
  const auto found = bridges(joined, 25.0, {});
  ASSERT_EQ(found.size(), 4U);  // of three places each
  for (const auto& bridge : found) {
    EXPECT_EQ(bridge.a.place, bridge.b.place);
    EXPECT_LT(vision::pose_error(bridge.a_from_b, Eigen::Isometry3d::Identity()).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace panvo::fleet

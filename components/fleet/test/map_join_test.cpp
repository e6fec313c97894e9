// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/map_join.hpp"

#include <gtest/gtest.h>

#include <random>

#include "made_up_maps.hpp"

namespace panvo::fleet {
namespace {

/// A place that looks like one 60 m farther on.
const Eigen::Isometry3d kWrong = flat(60.0, 20.0, 1.0);

MapJoin decide_on(const TwoMaps& maps) { return decide(maps.a, maps.b, {}); }

TEST(MapJoin, NeedsThreeSightingsThatAgree) {
  TwoMaps maps;
  EXPECT_EQ(decide_on(maps).reason, "no place of one was seen by the other");
  maps.a_sees(1, 1);
  EXPECT_FALSE(decide_on(maps).is_joined);
  maps.a_sees(2, 2);
  EXPECT_EQ(decide_on(maps).reason, "2 of 2 sightings agree, 3 needed");
  maps.a_sees(3, 3);
  EXPECT_TRUE(decide_on(maps).is_joined);
}

TEST(MapJoin, FindsTheTransformBetweenMapsOfUnknownPose) {
  TwoMaps maps;
  for (const std::uint32_t id : {2U, 3U, 4U}) maps.a_sees(id, id);
  maps.b_sees(6, 5);
  const auto join = decide_on(maps);
  ASSERT_TRUE(join.is_joined) << join.reason;
  EXPECT_EQ(join.agreeing, 4);
  const auto transform = fit(maps.a, maps.b, join.agreed, 3, {});
  ASSERT_TRUE(transform);
  EXPECT_LT(vision::pose_error(transform->a_from_b, maps.a_from_b()).norm(), 1e-9);
}

TEST(MapJoin, HasAnErrorWithinItsCovariance) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    TwoMaps maps;
    const JoinParameters exact{
        .position_sigma_m = 0.0, .rotation_sigma_deg = 0.0, .drift_ratio = 0.0, .drift_deg_per_m = 0.0};
    for (std::uint32_t id = 1; id <= 8; ++id) {
      const Eigen::Vector3d errors{normal(random), normal(random), normal(random)};
      auto error = flat(0.05 * errors.x(), 0.05 * errors.y(), 0.003 * errors.z());
      error.translation().z() = 0.05 * normal(random);
      error.linear() = vision::so3_exp({0.003 * normal(random), 0.003 * normal(random), 0.0}) * error.linear();
      maps.a_sees(id, id, error);
    }
    const auto transform = fit(maps.a, maps.b, cross_sightings(maps.a, maps.b), 4, exact);
    ASSERT_TRUE(transform);
    const auto error = vision::pose_error(transform->a_from_b, maps.a_from_b());
    sum += error.dot(transform->covariance.ldlt().solve(error)) / 6.0;
  }
  // the places have errors as well, of which these maps are free: the covariance is a little too large
  EXPECT_GT(sum / kTrials, 0.4);
  EXPECT_LT(sum / kTrials, 1.2);
}

TEST(MapJoin, IsNotMadeByAWrongSighting) {
  TwoMaps maps;
  maps.a_sees(1, 7, kWrong);
  EXPECT_FALSE(decide_on(maps).is_joined);
  maps.a_sees(2, 2);
  maps.a_sees(3, 3);
  const auto join = decide_on(maps);
  EXPECT_FALSE(join.is_joined) << "two right ones and a wrong one";
  EXPECT_EQ(join.agreeing, 2);
}

TEST(MapJoin, LeavesWrongSightingsOut) {
  TwoMaps maps;
  for (const std::uint32_t id : {1U, 2U, 3U, 4U}) maps.a_sees(id, id);
  maps.a_sees(5, 9, kWrong);
  maps.a_sees(6, 2, flat(-7.0, 3.0, 0.0));
  const auto join = decide_on(maps);
  ASSERT_TRUE(join.is_joined) << join.reason;
  EXPECT_EQ(join.agreeing, 4);
  EXPECT_EQ(join.contradicting, 1);
  const auto transform = fit(maps.a, maps.b, join.agreed, 3, {});
  ASSERT_TRUE(transform);
  EXPECT_LT(vision::pose_error(transform->a_from_b, maps.a_from_b()).norm(), 1e-9);
}

/// Three sightings that are wrong in the same way, as between two streets that look alike.
void see_wrongly(TwoMaps& maps) {
  const Eigen::Isometry3d world_error = flat(0.0, 30.0, 0.0);
  for (const std::uint32_t id : {1U, 2U, 3U}) maps.a_sees(id, id, world_error);
}

TEST(MapJoin, IsUndoneByContradictingSightingsAndMadeAnewByMoreOfThem) {
  TwoMaps maps;
  see_wrongly(maps);
  ASSERT_TRUE(decide_on(maps).is_joined) << "nothing contradicts the error yet";
  maps.a_sees(5, 5);
  EXPECT_TRUE(decide_on(maps).is_joined) << "one against three";
  maps.a_sees(6, 6);
  EXPECT_EQ(decide_on(maps).reason, "3 sightings agree, 2 others contradict them");
  for (const std::uint32_t id : {7U, 8U, 9U, 10U}) maps.a_sees(id, id);
  const auto join = decide_on(maps);
  ASSERT_TRUE(join.is_joined) << join.reason;
  EXPECT_EQ(join.agreeing, 6);
  EXPECT_EQ(join.contradicting, 3);
  const auto transform = fit(maps.a, maps.b, join.agreed, 8, {});
  ASSERT_TRUE(transform);
  EXPECT_LT(vision::pose_error(transform->a_from_b, maps.a_from_b()).norm(), 1e-9);
}

TEST(MapJoin, NeedsDifferentPlacesAndSomePath) {
  TwoMaps one_place;
  for (const std::uint32_t id : {1U, 2U, 3U}) one_place.a_sees(id, 2);
  EXPECT_EQ(decide_on(one_place).reason, "the places seen are within 0.0 m, 5.0 m needed");
  TwoMaps one_view;
  for (const std::uint32_t id : {1U, 2U, 3U}) one_view.a_sees(2, id);
  EXPECT_EQ(decide_on(one_view).reason, "seen on 0.0 m of path, 3.0 m needed");
  one_view.b_sees(2, 3);
  EXPECT_TRUE(decide_on(one_view).is_joined) << "the other robot saw them, too";
}

TEST(MapJoin, DoesNotBelieveAPlaceThatItsOwnerMovedByTwentyMetres) {
  TwoMaps maps;
  for (const std::uint32_t id : {1U, 2U, 3U, 4U}) maps.a_sees(id, id);
  const auto* place = maps.b.find(3);
  Eigen::Isometry3d moved = place->map_from_base;
  moved.translation().x() += 20.0;
  ASSERT_EQ(maps.b.move({{3, moved, place->covariance}}, 0.05, 0.01), 1U);
  const auto join = decide_on(maps);
  EXPECT_EQ(join.agreeing, 3);
  ASSERT_TRUE(join.is_joined) << join.reason;
  const auto transform = fit(maps.a, maps.b, join.agreed, 2, {});
  ASSERT_TRUE(transform);
  EXPECT_LT(vision::pose_error(transform->a_from_b, maps.a_from_b()).norm(), 1e-9);
}

TEST(MapJoin, RefusesMapsThatAreTilted) {
  TwoMaps maps;
  Eigen::Isometry3d tilted = Eigen::Isometry3d::Identity();
  tilted.linear() = vision::so3_exp({0.5, 0.0, 0.0});
  for (const std::uint32_t id : {1U, 2U, 3U}) {
    maps.a_sees(id, id, TwoMaps::world_place(id).inverse() * tilted * TwoMaps::world_place(id));
  }
  EXPECT_FALSE(decide_on(maps).is_joined);
}

TEST(MapJoin, IsNotMadeByVagueSightings) {
  TwoMaps maps;
  for (const std::uint32_t id : {1U, 2U, 3U}) {
    auto sighting = maps.sighting(id, {TwoMaps::kB, id}, Eigen::Isometry3d::Identity());
    sighting.covariance = covariance_of(5.0, 0.1);
    maps.a.add(sighting);
  }
  EXPECT_FALSE(decide_on(maps).is_joined);
}

TEST(MapJoin, AllowsForTheDriftBetweenPlacesThatAreFarApart) {
  // Map b is bent: its places are off by 1 % of their distance along the road.
  TwoMaps maps;
  std::vector<landmarks::LandmarkPose> bent;
  for (const auto& [id, place] : maps.b.places()) {
    bent.push_back({id, maps.b_from_world * flat(10.1 * id, 0.0, 0.0), place.landmark.covariance});
  }
  maps.b.move(bent, 0.0, 0.0);
  for (const std::uint32_t id : {1U, 6U, 12U}) maps.a_sees(id, id);
  EXPECT_TRUE(decide_on(maps).is_joined);
  EXPECT_FALSE(
      decide(maps.a, maps.b, {.position_sigma_m = 0.01, .drift_ratio = 0.0, .drift_deg_per_m = 0.0}).is_joined);
}

TEST(MapJoin, FitsBestNearTheGivenPlace) {
  TwoMaps maps;
  std::vector<landmarks::LandmarkPose> bent;
  for (const auto& [id, place] : maps.b.places()) {
    bent.push_back({id, maps.b_from_world * flat(10.1 * id, 0.0, 0.0), place.landmark.covariance});
  }
  maps.b.move(bent, 0.0, 0.0);
  for (std::uint32_t id = 1; id <= TwoMaps::kPlaces; ++id) maps.a_sees(id, id);
  const auto agreed = decide_on(maps).agreed;
  const auto error_at = [&](std::uint32_t near) {
    const auto transform = fit(maps.a, maps.b, agreed, near, {});
    return (transform->a_from_b * maps.b.find(12)->map_from_base.translation() -
            maps.a.find(12)->map_from_base.translation())
        .norm();
  };
  EXPECT_LT(error_at(12), 0.2);
  EXPECT_GT(error_at(1), 2.0 * error_at(12));
}

TEST(MapJoin, UsesTheLatestSightingsOfEachDirection) {
  TwoMaps maps;
  for (int i = 0; i < 50; ++i)
    maps.a_sees(1 + static_cast<std::uint32_t>(i) % 12, 1 + static_cast<std::uint32_t>(i) % 12);
  EXPECT_EQ(cross_sightings(maps.a, maps.b).size(), 32U);
  maps.b_sees(1, 1);
  EXPECT_EQ(cross_sightings(maps.a, maps.b).size(), 33U);
}

TEST(RelativeCovariance, IsWhatTheLaterPlaceHasMore) {
  const JoinParameters no_drift{.drift_ratio = 0.0, .drift_deg_per_m = 0.0};
  const auto early = covariance_of(0.5, 0.0), late = covariance_of(0.6, 0.0);
  const auto gained = relative_covariance(flat(0, 0, 0), early, flat(10, 0, 1.0), late, no_drift);
  EXPECT_NEAR(gained(0, 0), 0.6 * 0.6 - 0.5 * 0.5, 1e-9);
  // at a correction the later place is the better known one
  const auto corrected = relative_covariance(flat(0, 0, 0), late, flat(10, 0, 1.0), early, no_drift);
  EXPECT_NEAR(corrected(0, 0), 0.6 * 0.6 - 0.5 * 0.5, 1e-9);
}

}  // namespace
}  // namespace panvo::fleet

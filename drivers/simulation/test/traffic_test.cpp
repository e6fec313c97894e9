// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/traffic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "../src/footprint.hpp"
#include "panvo/simulation/revisits.hpp"

namespace panvo::simulation {

using simulated_world::MoverModels;

namespace {

MoverModels some_models() {
  MoverModels models;
  models.cars = {0, 1, 2};
  models.vans = {3, 4};
  models.people = {5, 6};
  models.own_vehicle = 7;
  return models;
}

// The parts of a journey, to which Traffic keeps references.
struct TrafficDrive {
  TrafficDrive(const std::string& name, std::uint64_t seed)
      : site({seed, 0.6, false}, simulated_world::campus_roads(seed), nullptr),
        motion(drive(site.roads, read_route(std::filesystem::path(PANVO_CONFIG) / "routes" / (name + ".yaml"))),
               site.terrain, {}, seed),
        traffic(site, motion, some_models(), seed) {}

  Footprint own(double t_s) const {
    const Eigen::Isometry3d pose = motion.world_from_base(t_s);
    return {pose.translation().head<2>(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)), 4.2, 1.8};
  }
  Footprint of(const Mover& mover, double t_s) const {
    const auto [position, heading] = ground_place(mover, motion, t_s);
    return {position, heading, mover.length_m, mover.width_m};
  }

  simulated_world::Site site;
  VehicleMotion motion;
  Traffic traffic;
};

class ShippedRoute : public testing::TestWithParam<std::string> {};

TEST_P(ShippedRoute, MeetsMoversOfEveryKindThatNeverTouchTheVehicleAndComeFromOutOfSight) {
  std::map<std::string, int> met;
  double minutes = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TrafficDrive journey(GetParam(), seed);
    const double duration = journey.motion.duration_s();
    double least = 1e9;
    for (const Mover& mover : journey.traffic.movers()) {
      for (double t = std::max(0.0, mover.from_s); t <= std::min(mover.to_s, duration); t += 0.07) {
        least = std::min(least, distance(journey.of(mover, t), journey.own(t)));
      }
      for (const double t : {mover.from_s, mover.to_s}) {
        if (t < 0.0 || t > duration) continue;
        EXPECT_GT((journey.of(mover, t).centre - journey.own(t).centre).norm(), 25.0) << "seed " << seed << " t " << t;
      }
    }
    EXPECT_GT(least, 0.3) << "seed " << seed;
    for (const auto& episode : journey.traffic.episodes()) {
      EXPECT_LT(episode.from_s, episode.to_s);
      EXPECT_LT(episode.to_s, duration + 0.1);
      ++met[episode.kind];
    }
    minutes += duration / 60.0;
  }
  EXPECT_GE(met["ahead"], 0.6 * minutes);
  EXPECT_GE(met["oncoming"], 1.5 * minutes);
  EXPECT_GE(met["crossing"], 0.5 * minutes);
  EXPECT_GE(met["pedestrian"], 1.0 * minutes);
}

INSTANTIATE_TEST_SUITE_P(Traffic, ShippedRoute, testing::Values("short", "corner", "dataset_i", "dataset_ii"));

TEST(Traffic, IsTheSameForTheSameSeed) {
  const TrafficDrive a("short", 2), b("short", 2);
  for (double t = 0.0; t < a.motion.duration_s(); t += 3.1) {
    const auto one = a.traffic.at(t, t + 0.003), two = b.traffic.at(t, t + 0.003);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].at_opening.model, two[i].at_opening.model);
      EXPECT_EQ(one[i].at_opening.world_from_model.matrix(), two[i].at_opening.world_from_model.matrix());
    }
  }
}

TEST(Traffic, StandsOnTheGroundAndMovesOnSmoothly) {
  const TrafficDrive journey("corner", 1);
  for (double t = 0.0; t < journey.motion.duration_s() - 0.2; t += 0.2) {
    for (const simulated_world::MovingPlacement& placement : journey.traffic.at(t, t + 0.04)) {
      const Eigen::Vector3f from = placement.at_opening.world_from_model.translation();
      const Eigen::Vector3f to = placement.world_from_model_closed.translation();
      EXPECT_LT((to - from).norm(), 0.04 * 12.0);
      EXPECT_NEAR(from.z(), journey.site.terrain.height_m(from.head<2>().cast<double>()), 0.2);
      EXPECT_NEAR(placement.at_opening.world_from_model.linear().determinant(), 1.0f, 1e-4f);
    }
  }
}

TEST(Traffic, KeepsAVanAheadThroughTheWeaklyTexturedCorner) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TrafficDrive journey("corner", seed);
    bool ahead = false;
    for (const Visit& visit : find_visits(journey.site.roads, journey.motion)) {
      if (!journey.site.roads.junctions[static_cast<std::size_t>(visit.junction)].has_weak_texture) continue;
      for (const auto& episode : journey.traffic.episodes()) {
        ahead |= episode.kind == "ahead" && episode.from_s < visit.entered_s && episode.to_s > visit.left_s;
      }
    }
    EXPECT_TRUE(ahead) << "seed " << seed;
  }
}

TEST(Traffic, NeedsModelsOfEveryKind) {
  const TrafficDrive journey("short", 1);
  MoverModels none = some_models();
  none.people.clear();
  EXPECT_THROW(Traffic(journey.site, journey.motion, none, 1), std::invalid_argument);
}

TEST(Footprint, DistancesAreThoseOfTheRectangles) {
  const Footprint car{{0.0, 0.0}, 0.0, 4.0, 2.0};
  EXPECT_DOUBLE_EQ(distance(car, {{5.0, 0.0}, 0.0, 4.0, 2.0}), 1.0);
  EXPECT_NEAR(distance(car, {{0.0, 3.0}, M_PI / 2.0, 2.0, 4.0}), 1.0, 1e-12);
  EXPECT_NEAR(distance(car, {{5.0, 5.0}, 0.0, 4.0, 2.0}), std::hypot(1.0, 3.0), 1e-12);
  EXPECT_NEAR(distance(car, {{4.0, 0.0}, M_PI / 4.0, 2.0, 2.0}), 2.0 - std::sqrt(2.0), 1e-12);
  EXPECT_EQ(distance(car, {{0.0, 0.0}, M_PI / 2.0, 8.0, 0.5}), 0.0);  // crossing, no corner inside the other
  EXPECT_EQ(distance(car, {{0.0, 0.0}, 0.3, 1.0, 0.5}), 0.0);         // one inside the other
}

}  // namespace
}  // namespace panvo::simulation

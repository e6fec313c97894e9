// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "panvo/simulated_world/road_network.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kPi = std::numbers::pi;

const Junction& end_of(const RoadNetwork& network, int number) {
  return network.junctions[static_cast<std::size_t>(number)];
}

TEST(CampusRoads, AreTheSameForTheSameSeed) {
  const RoadNetwork a = campus_roads(7), b = campus_roads(7), c = campus_roads(8);
  ASSERT_EQ(a.roads.size(), b.roads.size());
  for (std::size_t i = 0; i < a.roads.size(); ++i) EXPECT_EQ(a.roads[i].centre_line, b.roads[i].centre_line);
  EXPECT_NE(a.junctions[0].position, c.junctions[0].position);
}

TEST(CampusRoads, KeepTheirPlanOnEverySeed) {
  const RoadNetwork first = campus_roads(1);
  for (std::uint64_t seed = 2; seed <= 20; ++seed) {
    const RoadNetwork network = campus_roads(seed);
    ASSERT_EQ(network.roads.size(), first.roads.size());
    for (std::size_t i = 0; i < first.roads.size(); ++i) {
      EXPECT_EQ(network.roads[i].from, first.roads[i].from);
      EXPECT_EQ(network.roads[i].to, first.roads[i].to);
    }
    for (std::size_t i = 0; i < first.junctions.size(); ++i) {
      EXPECT_LT((network.junctions[i].position - first.junctions[i].position).norm(), 12.01);
    }
  }
}

TEST(CampusRoads, HaveJunctionsOfEveryKind) {
  const RoadNetwork network = campus_roads(1);
  std::set<std::size_t> degrees;
  int crossings = 0, weak = 0, loops = 0;
  for (const Junction& junction : network.junctions) {
    degrees.insert(junction.roads.size());
    crossings += junction.is_crossing() ? 1 : 0;
    weak += junction.has_weak_texture ? 1 : 0;
  }
  for (const Road& road : network.roads) loops += road.from == road.to ? 1 : 0;
  EXPECT_EQ(degrees, (std::set<std::size_t>{1, 3, 4, 5}));
  EXPECT_GE(crossings, 15);
  EXPECT_GE(weak, 1);
  EXPECT_EQ(loops, 1);
}

TEST(CampusRoads, RunFromJunctionToJunctionInStepsOfAMetre) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const RoadNetwork network = campus_roads(seed);
    for (const Road& road : network.roads) {
      EXPECT_EQ(road.centre_line.front(), end_of(network, road.from).position);
      EXPECT_EQ(road.centre_line.back(), end_of(network, road.to).position);
      for (std::size_t i = 1; i < road.centre_line.size(); ++i) {
        const double step = (road.centre_line[i] - road.centre_line[i - 1]).norm();
        ASSERT_GT(step, 0.95);
        ASSERT_LE(step, road.max_step_m);
      }
    }
  }
}

// Two roads that meet at a junction may be close near it; elsewhere there must be room for pavements and houses.
double separation(const RoadNetwork& network) {
  double least = 1e9;
  for (std::size_t a = 0; a < network.roads.size(); ++a) {
    for (std::size_t b = a; b < network.roads.size(); ++b) {
      const Road &one = network.roads[a], &two = network.roads[b];
      for (std::size_t i = 0; i < one.centre_line.size(); i += 2) {
        for (std::size_t j = 0; j < two.centre_line.size(); j += 2) {
          const Eigen::Vector2d &p = one.centre_line[i], &q = two.centre_line[j];
          const double apart = (p - q).norm();
          if (apart >= least || (a == b && std::max(i, j) - std::min(i, j) < 40)) continue;
          bool near_junction = false;
          for (const int end : {one.from, one.to}) {
            const Eigen::Vector2d& centre = end_of(network, end).position;
            const bool shared = end == two.from || end == two.to;
            near_junction |= shared && std::min((p - centre).norm(), (q - centre).norm()) < 28.0;
          }
          if (!near_junction) least = apart;
        }
      }
    }
  }
  return least;
}

TEST(CampusRoads, KeepClearOfEachOther) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) EXPECT_GT(separation(campus_roads(seed)), 18.0) << "seed " << seed;
}

TEST(CampusRoads, MeetAtNoLessThan35Degrees) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const RoadNetwork network = campus_roads(seed);
    for (std::size_t number = 0; number < network.junctions.size(); ++number) {
      std::vector<double> arms;
      for (const Road& road : network.roads) {
        const auto& line = road.centre_line;
        for (const bool at_start : {true, false}) {
          if ((at_start ? road.from : road.to) != static_cast<int>(number)) continue;
          const Eigen::Vector2d way = at_start ? line[12] - line[0] : line[line.size() - 13] - line.back();
          arms.push_back(std::atan2(way.y(), way.x()));
        }
      }
      EXPECT_EQ(arms.size(), network.junctions[number].roads.size());
      std::sort(arms.begin(), arms.end());
      for (std::size_t i = 0; arms.size() > 1 && i < arms.size(); ++i) {
        const double next = i + 1 < arms.size() ? arms[i + 1] : arms[0] + 2.0 * kPi;
        EXPECT_GT(next - arms[i], 35.0 * kPi / 180.0) << "seed " << seed << " " << network.junctions[number].name;
      }
    }
  }
}

TEST(CampusRoads, AreSmooth) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const Road& road : campus_roads(seed).roads) {
      for (std::size_t i = 1; i + 1 < road.centre_line.size(); ++i) {
        const Eigen::Vector2d a = road.centre_line[i] - road.centre_line[i - 1];
        const Eigen::Vector2d b = road.centre_line[i + 1] - road.centre_line[i];
        ASSERT_LT(std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))), 0.14)
            << "seed " << seed;  // radius 7 m
      }
    }
  }
}

}  // namespace
}  // namespace panvo::simulated_world

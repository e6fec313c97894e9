// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "panvo/simulated_world/random.hpp"
#include "panvo/simulated_world/road_network.hpp"

namespace panvo::simulated_world {

namespace {

using Eigen::Vector2d;

struct PlannedJunction {
  const char* name;
  double east_m, north_m;
  bool has_weak_texture = false;
};

struct PlannedRoad {
  const char *from, *to;
  double width_m;
  std::vector<Vector2d> bends;  // points on the way
};

// Rows from north to south, each from west to east.
constexpr std::array kJunctions{
    PlannedJunction{"stadium", -125, 140},     PlannedJunction{"library", -38, 146},
    PlannedJunction{"theatre", 34, 116},       PlannedJunction{"park", 146, 112},
    PlannedJunction{"boiler_house", -205, 58}, PlannedJunction{"canteen", -118, 62},
    PlannedJunction{"auditorium", -42, 72},    PlannedJunction{"museum", 48, 44},
    PlannedJunction{"hospital", 130, 52},      PlannedJunction{"east_gate", 215, 66},
    PlannedJunction{"workshop", -188, -28},    PlannedJunction{"gymnasium", -108, -18},
    PlannedJunction{"clock_tower", -28, -12},  PlannedJunction{"bookshop", 58, -28},
    PlannedJunction{"post_office", 140, -22},  PlannedJunction{"laboratory", -124, -96, true},
    PlannedJunction{"dormitory", -48, -88},    PlannedJunction{"chapel", 30, -100},
    PlannedJunction{"bank", 108, -90},         PlannedJunction{"pond", 192, -92},
    PlannedJunction{"gate", -152, -168},       PlannedJunction{"kindergarten", -84, -150},
    PlannedJunction{"garage", -8, -164},       PlannedJunction{"printing_house", 78, -162},
};

const std::vector<PlannedRoad>& planned_roads() {
  static const std::vector<PlannedRoad> kRoads{
      {"boiler_house", "stadium", 6.5, {{-208, 108}, {-178, 138}}},
      {"stadium", "library", 7.0, {{-82, 136}}},
      {"library", "theatre", 7.0, {}},
      {"theatre", "park", 6.5, {{92, 128}}},
      {"park", "park", 6.0, {{170, 107}, {188, 124}, {179, 146}, {160, 147}, {150, 130}}},  // a loop
      {"stadium", "canteen", 7.0, {}},
      {"library", "auditorium", 7.0, {}},
      {"theatre", "auditorium", 7.0, {}},
      {"theatre", "museum", 7.0, {}},
      {"park", "hospital", 7.0, {}},
      {"boiler_house", "canteen", 6.5, {}},
      {"canteen", "auditorium", 7.0, {}},
      {"museum", "hospital", 7.5, {}},
      {"hospital", "east_gate", 7.0, {}},  // a cul-de-sac
      {"boiler_house", "workshop", 6.5, {}},
      {"canteen", "gymnasium", 7.0, {}},
      {"auditorium", "clock_tower", 7.5, {}},
      {"clock_tower", "museum", 8.0, {}},
      {"museum", "bookshop", 7.0, {}},
      {"hospital", "post_office", 7.5, {}},
      {"workshop", "gymnasium", 6.5, {}},
      {"gymnasium", "clock_tower", 8.0, {}},
      {"clock_tower", "bookshop", 8.0, {}},
      {"bookshop", "post_office", 8.0, {}},
      {"workshop", "laboratory", 6.5, {{-199, -62}, {-170, -82}, {-152, -102}}},  // an S
      {"gymnasium", "laboratory", 7.0, {}},
      {"clock_tower", "dormitory", 7.5, {}},
      {"bookshop", "chapel", 7.0, {}},
      {"post_office", "bank", 7.0, {}},
      {"post_office", "pond", 6.5, {{170, -40}}},
      {"laboratory", "dormitory", 7.0, {}},
      {"dormitory", "chapel", 7.0, {}},
      {"chapel", "bank", 7.0, {}},
      {"bank", "pond", 6.5, {}},
      {"laboratory", "kindergarten", 7.0, {}},
      {"kindergarten", "gate", 7.0, {}},
      {"kindergarten", "garage", 6.5, {}},
      {"dormitory", "garage", 6.5, {}},
      {"chapel", "garage", 6.5, {}},
      {"garage", "printing_house", 6.5, {}},
      {"bank", "printing_house", 6.5, {}},
      {"printing_house", "pond", 6.5, {{142, -164}, {182, -138}}},
  };
  return kRoads;
}

Vector2d turned(const Vector2d& way, double angle) {
  return {std::cos(angle) * way.x() - std::sin(angle) * way.y(), std::sin(angle) * way.x() + std::cos(angle) * way.y()};
}

double angle_between(const Vector2d& a, const Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

// Directions of a curve at each of `points`: those of the circle through three neighbours.
std::vector<Vector2d> ways_through(const std::vector<Vector2d>& points) {
  std::vector<Vector2d> ways(points.size());
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vector2d before = points[i] - points[i - 1], after = points[i + 1] - points[i];
    const double turn = angle_between(before, after) * before.norm() / (before.norm() + after.norm());
    ways[i] = turned(before.normalized(), turn);
  }
  const auto mirrored = [](const Vector2d& chord, const Vector2d& way) {
    return turned(chord.normalized(), angle_between(way, chord));
  };
  if (points.size() == 2) return {(points[1] - points[0]).normalized(), (points[1] - points[0]).normalized()};
  ways.front() = mirrored(points[1] - points[0], ways[1]);
  ways.back() = mirrored(points.back() - points[points.size() - 2], ways[points.size() - 2]);
  return ways;
}

// A smooth curve through `points` with these directions, as evenly spaced points at most a metre apart.
std::vector<Vector2d> curve(const std::vector<Vector2d>& points, const std::vector<Vector2d>& ways) {
  constexpr int kFine = 400;  // per piece: the chords' length equals the curve's to a millimetre
  std::vector<Vector2d> fine{points.front()};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double length = (points[i + 1] - points[i]).norm();
    // the Hermite tangents of an arc are longer than its chord, increasingly with its angle
    const double turn = std::abs(angle_between(ways[i], ways[i + 1])) / 4.0;
    const double speed = length / (std::cos(turn) * std::cos(turn));
    for (int k = 1; k <= kFine; ++k) {
      const double u = static_cast<double>(k) / kFine, v = 1.0 - u;
      fine.emplace_back(v * v * (1.0 + 2.0 * u) * points[i] + u * u * (3.0 - 2.0 * u) * points[i + 1] +
                        speed * u * v * (v * ways[i] - u * ways[i + 1]));
    }
  }
  std::vector<double> along(fine.size(), 0.0);
  for (std::size_t i = 1; i < fine.size(); ++i) along[i] = along[i - 1] + (fine[i] - fine[i - 1]).norm();
  const auto steps = static_cast<std::size_t>(std::ceil(along.back()));
  std::vector<Vector2d> even{fine.front()};
  std::size_t j = 1;
  for (std::size_t k = 1; k < steps; ++k) {
    const double at = along.back() * static_cast<double>(k) / static_cast<double>(steps);
    while (along[j] < at) ++j;
    const double share = (at - along[j - 1]) / (along[j] - along[j - 1]);
    even.emplace_back(fine[j - 1] + share * (fine[j] - fine[j - 1]));
  }
  even.push_back(fine.back());
  return even;
}

// The plan with everything moved by up to several metres, times `scale`.
RoadNetwork moved_plan(const Random& random, double scale) {
  constexpr double kJunctionShift_m = 6.0, kBendShift_m = 2.5, kStraightBend_m = 2.5, kArmTurn_rad = 0.035;
  RoadNetwork network;
  std::vector<Vector2d> shifts;
  for (const PlannedJunction& planned : kJunctions) {
    Random own = random.part(shifts.size());
    const double distance = scale * kJunctionShift_m * std::sqrt(own.uniform());
    shifts.push_back(turned({distance, 0.0}, own.uniform(0.0, 2.0 * std::numbers::pi)));
    network.junctions.push_back(
        {planned.name, Vector2d(planned.east_m, planned.north_m) + shifts.back(), {}, planned.has_weak_texture});
  }
  for (const PlannedRoad& planned : planned_roads()) {
    Random own = random.part(1000 + network.roads.size());
    const int from = network.find(planned.from).value(), to = network.find(planned.to).value();
    const Vector2d shift_from = shifts[static_cast<std::size_t>(from)], shift_to = shifts[static_cast<std::size_t>(to)];
    std::vector<Vector2d> points{network.junctions[static_cast<std::size_t>(from)].position - shift_from};
    points.insert(points.end(), planned.bends.begin(), planned.bends.end());
    points.push_back(network.junctions[static_cast<std::size_t>(to)].position - shift_to);
    const std::vector<Vector2d> planned_ways = ways_through(points);

    for (std::size_t i = 0; i < points.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(points.size() - 1);
      points[i] += (1.0 - share) * shift_from + share * shift_to;
      if (i > 0 && i + 1 < points.size()) {
        points[i] += scale * kBendShift_m * Vector2d(own.uniform(-1.0, 1.0), own.uniform(-1.0, 1.0));
      }
    }
    if (planned.bends.empty()) {
      const Vector2d across = turned((points[1] - points[0]).normalized(), std::numbers::pi / 2.0);
      const Vector2d middle = 0.5 * (points[0] + points[1]) + scale * kStraightBend_m * own.uniform(-1.0, 1.0) * across;
      points.insert(points.begin() + 1, middle);
    }
    std::vector<Vector2d> ways = ways_through(points);
    // arms stay near their planned directions, which determine the routes' entrance angles at revisits
    for (const bool at_start : {true, false}) {
      Vector2d& way = at_start ? ways.front() : ways.back();
      const Vector2d& plan = at_start ? planned_ways.front() : planned_ways.back();
      way = turned(plan, 0.3 * angle_between(plan, way) + scale * kArmTurn_rad * own.uniform(-1.0, 1.0));
    }
    network.roads.push_back({from, to, curve(points, ways), planned.width_m, 1.001});
  }
  network.join();
  return network;
}

}  // namespace

RoadNetwork campus_roads(std::uint64_t seed) { return moved_plan(Random(seed, "campus roads"), 1.0); }

}  // namespace panvo::simulated_world

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "traffic_planner.hpp"

namespace panvo::simulation {

using simulated_world::Random;
using simulated_world::Road;
using simulated_world::RoadNetwork;

namespace {

using Eigen::Vector2d;

Vector2d left_normal(double heading) { return {-std::sin(heading), std::cos(heading)}; }
Vector2d along(double heading) { return {std::cos(heading), std::sin(heading)}; }

}  // namespace

Mover TrafficPlanner::person(Random& random) const {
  Mover mover;
  mover.walks = true;
  mover.model = models_.people[static_cast<std::size_t>(random.below(static_cast<int>(models_.people.size())))];
  mover.length_m = mover.width_m = 0.6;
  return mover;
}

// A pedestrian who crosses the road in front of the vehicle, and is in the middle of its lane when the vehicle is 6 to
// 10 m away.
std::optional<Mover> TrafficPlanner::road_crosser(double t_s, Random random) const {
  const double gap = 0.5 * kOwnLength_m + random.uniform(6.0, 10.0);
  const double at_m = motion_.travelled_m(t_s) + gap;
  const DrivenPath& path = motion_.path();
  if (motion_.speed_m_per_s(t_s) < 0.4 * motion_.cruise_speed_m_per_s() || at_m + 5.0 > path.along_m.back())
    return std::nullopt;
  const auto i = static_cast<std::size_t>(std::lower_bound(path.along_m.begin(), path.along_m.end() - 1, at_m) -
                                          path.along_m.begin());
  const RoadNetwork::Nearest nearest = site_.roads.nearest_road(path.points[i]);
  const Road& road = site_.roads.roads[static_cast<std::size_t>(nearest.road)];
  const Vector2d way = (path.points[i] - path.points[i - 1]).normalized();
  const double heading = std::atan2(way.y(), way.x());
  const Vector2d middle = path.points[i] + std::abs(nearest.side_m) * left_normal(heading);
  const double half = 0.5 * road.width_m + 1.1;
  const double side = random.chance(0.5) ? 1.0 : -1.0;  // side on which the pedestrian starts
  const double before = random.chance(0.5) ? 1.0 : -1.0, after = random.chance(0.5) ? 1.0 : -1.0;

  Mover mover = person(random);
  mover.speed_m_per_s = random.uniform(1.4, 1.9);
  // along the pavement, around a corner, across, around a corner, along the other pavement
  constexpr double kWalk_m = 25.0, kRound_m = 1.0;
  const Vector2d a = middle + side * half * left_normal(heading), b = middle - side * half * left_normal(heading);
  const Vector2d start = a - before * kWalk_m * along(heading), end = b + after * kWalk_m * along(heading);
  const auto bend = [&](const Vector2d& from, const Vector2d& corner, const Vector2d& to) {
    const Vector2d p = corner + kRound_m * (from - corner).normalized(),
                   q = corner + kRound_m * (to - corner).normalized();
    for (int k = 0; k <= 8; ++k) {
      const double u = k / 8.0, v = 1.0 - u;
      mover.path.emplace_back(v * v * p + 2.0 * u * v * corner + u * u * q);
    }
  };
  mover.path.push_back(start);
  bend(start, a, b);
  bend(a, b, end);
  mover.path.push_back(end);
  measure(mover);
  // the pavement must extend along the walk, without another road
  for (double walked = 0.0; walked <= 12.0; walked += 3.0) {
    for (const Vector2d& point :
         {Vector2d(a - before * walked * along(heading)), Vector2d(b + after * walked * along(heading))}) {
      const double off = site_.distance_from_kerb(point);
      if (off < 0.3 || off > 2.2) return std::nullopt;
    }
  }
  live_waiting(mover, kWalk_m + half - side * std::abs(nearest.side_m), t_s);
  return mover;
}

void TrafficPlanner::plan_road_crossers() {
  std::uint64_t proposal = 50000;
  for (double t = 8.0; t < motion_.duration_s() - 4.0;) {
    bool found = false;
    for (int attempt = 0; attempt < 8 && !found; ++attempt) {
      Random random = random_.part(proposal++);
      const double meeting_s = t + random.uniform(-4.0, 4.0);
      found = accept(road_crosser(meeting_s, random), 0.6, 0.5, "pedestrian", 12.0);
    }
    Random pause = random_.part(proposal++);
    t += found ? pause.uniform(18.0, 30.0) : 5.0;
  }
}

// A pedestrian on the pavement of the vehicle's road or of a side road.
std::optional<Mover> TrafficPlanner::stroller(double t_s, Random random) const {
  const Footprint here = own(t_s);
  const RoadNetwork::Nearest nearest =
      site_.roads.nearest_road(here.centre + 25.0 * Vector2d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)));
  const Road& road = site_.roads.roads[static_cast<std::size_t>(nearest.road)];
  Mover mover = person(random);
  mover.speed_m_per_s = random.uniform(1.0, 1.6);
  const double off = 0.5 * road.width_m + random.uniform(0.7, 1.4);
  const double side = random.chance(0.5) ? off : -off;
  const auto& line = road.centre_line;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Vector2d way = (line[i + 1] - line[i - 1]).normalized();
    const Vector2d point = line[i] + side * Vector2d(-way.y(), way.x());
    const double from_kerb = site_.distance_from_kerb(point);
    if (from_kerb > 0.5 && from_kerb < 2.0) {
      mover.path.push_back(point);
    } else if (i > line.size() / 2) {
      break;
    } else {
      mover.path.clear();
    }
  }
  if (mover.path.size() < 20) return std::nullopt;
  if (random.chance(0.5)) std::reverse(mover.path.begin(), mover.path.end());
  measure(mover);
  live_waiting(mover, random.uniform(0.25, 0.75) * mover.along_m.back(), t_s);
  return mover;
}

void TrafficPlanner::plan_strollers() {
  std::uint64_t proposal = 70000;
  for (double t = 2.0; t < motion_.duration_s();) {
    Random random = random_.part(proposal++);
    accept(stroller(t, random), 0.6, 0.4, nullptr, 0.0);
    t += random.uniform(1.5, 4.0);
  }
}

}  // namespace panvo::simulation

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "traffic_planner.hpp"

namespace panvo::simulation {

using simulated_world::Random;
using simulated_world::Road;
using simulated_world::RoadNetwork;

namespace {

using Eigen::Vector2d;

constexpr double kMinHidden_m = 26.0;  // smallest distance at which one ahead may appear or vanish: our road winds

std::size_t nearest_index(const std::vector<Vector2d>& points, const Vector2d& point) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - point).squaredNorm() < (points[best] - point).squaredNorm()) best = i;
  }
  return best;
}

}  // namespace

Mover TrafficPlanner::vehicle_of(bool is_van, Random& random) const {
  Mover mover;
  const auto& models = is_van ? models_.vans : models_.cars;
  const int model = random.below(static_cast<int>(models.size()));
  mover.model = models[static_cast<std::size_t>(model)];
  // the first van is a delivery van, further ones may be buses and lorries
  mover.length_m = !is_van ? 4.7 : model == 0 ? 5.0 : 6.7;
  mover.width_m = !is_van ? 1.9 : model == 0 ? 2.0 : 2.25;
  const auto paint = [&] { return static_cast<std::uint8_t>(random.uniform(70.0, 255.0)); };
  mover.tint = {paint(), paint(), paint(), 255};
  if (is_van || random.chance(0.55)) mover.tint.green = mover.tint.blue = mover.tint.red;  // most are grey or white
  return mover;
}

void TrafficPlanner::walk_on(std::vector<int>& junctions, int count, Random& random) const {
  for (int k = 0; k < count; ++k) {
    const int here = junctions.back(), before = junctions[junctions.size() - 2];
    std::vector<int> next;
    for (const int number : site_.roads.junctions[static_cast<std::size_t>(here)].roads) {
      const Road& road = site_.roads.roads[static_cast<std::size_t>(number)];
      const int other = road.from == here ? road.to : road.from;
      if (other != here && other != before) next.push_back(other);
    }
    if (next.empty()) return;
    junctions.push_back(next[static_cast<std::size_t>(random.below(static_cast<int>(next.size())))]);
  }
}

// A mover along these junctions that reaches the point of its path nearest to `meeting` at `meeting_s`.
std::optional<Mover> TrafficPlanner::passing(const std::vector<int>& junctions, const Vector2d& meeting,
                                             double meeting_s, bool is_van, Random random) const {
  Route route;
  for (const int junction : junctions) {
    route.junctions.push_back(site_.roads.junctions[static_cast<std::size_t>(junction)].name);
  }
  Mover mover = vehicle_of(is_van, random);
  mover.path = drive(site_.roads, route).points;
  measure(mover);
  mover.speed_m_per_s = random.uniform(4.5, 7.0);
  if (!live(mover, mover.along_m[nearest_index(mover.path, meeting)], meeting_s)) return std::nullopt;
  return mover;
}

// --- ahead of the vehicle in its lane

std::optional<Mover> TrafficPlanner::ahead(double near_middle_s, Random random) const {
  Mover mover = vehicle_of(random.chance(0.75), random);
  mover.keeps_ahead = true;
  // its rear is 2.5 to 4 m ahead of our front: it hides about half of a forward camera's view
  mover.near_m = 0.5 * mover.length_m + 0.5 * kOwnLength_m + random.uniform(2.5, 4.0);
  const double stays = random.uniform(8.0, 12.0);
  mover.near_from_s = near_middle_s - 0.5 * stays;
  mover.near_to_s = near_middle_s + 0.5 * stays;
  mover.far_m = random.uniform(46.0, 55.0);
  // the gap must not close faster than our speed in turns, or the mover would drive backwards
  const double speed = std::min(motion_.cruise_speed_m_per_s(), 5.0);
  mover.from_s = mover.near_from_s - (mover.far_m - mover.near_m) / (0.38 * speed);
  mover.to_s = mover.near_to_s + (mover.far_m - mover.near_m) / (0.64 * speed);

  // our own path, extended along the road on which it ends
  const DrivenPath& path = motion_.path();
  mover.path = path.points;
  const RoadNetwork::Nearest end = site_.roads.nearest_road(path.points.back());
  const Road& road = site_.roads.roads[static_cast<std::size_t>(end.road)];
  if (road.from != road.to) {
    const bool onwards = end.side_m < 0.0;  // in the right-hand lane of the centre line's direction
    std::vector<int> junctions{onwards ? road.from : road.to, onwards ? road.to : road.from};
    walk_on(junctions, 2, random);
    Route route;
    for (const int junction : junctions) {
      route.junctions.push_back(site_.roads.junctions[static_cast<std::size_t>(junction)].name);
    }
    const auto beyond = drive(site_.roads, route).points;
    const std::size_t from = nearest_index(beyond, path.points.back()) + 2;
    mover.path.insert(mover.path.end(), beyond.begin() + static_cast<std::ptrdiff_t>(std::min(from, beyond.size())),
                      beyond.end());
  }
  measure(mover);
  if (mover.near_from_s < 0.0 || mover.near_to_s > motion_.duration_s()) return std::nullopt;
  for (const double t : {mover.from_s, mover.to_s}) {
    const bool is_seen = t >= 0.0 && t <= motion_.duration_s();
    if (is_seen && (of(mover, t).centre - own(t).centre).norm() < kMinHidden_m) return std::nullopt;
  }
  const double last = motion_.travelled_m(std::min(mover.to_s, motion_.duration_s())) + mover.far_m;
  if (last > mover.along_m.back() && mover.to_s < motion_.duration_s()) return std::nullopt;
  return mover;
}

void TrafficPlanner::plan_ahead() {
  constexpr double kApart_s = 55.0;
  // first where it is hardest for a camera: in sharp turns, with those at weak texture first
  std::vector<std::pair<int, double>> wishes;
  for (const Visit& visit : visits_) {
    const double turn =
        std::abs(std::remainder(visit.heading_left_rad - visit.heading_entered_rad, 2.0 * std::numbers::pi));
    const bool weak = site_.roads.junctions[static_cast<std::size_t>(visit.junction)].has_weak_texture;
    if (turn > 1.0) wishes.emplace_back(weak ? 0 : 2, visit.closest_s);
  }
  for (double t = 24.0; t < motion_.duration_s(); t += 5.0) wishes.emplace_back(t < 30.0 ? 1 : 3, t);
  std::stable_sort(wishes.begin(), wishes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> taken;
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    for (std::uint64_t attempt = 0; attempt < 3; ++attempt) {
      Random random = random_.part(1000 + 10 * i + attempt);
      const double middle = wishes[i].second + random.uniform(-2.0, 2.0);
      const bool crowded =
          std::any_of(taken.begin(), taken.end(), [&](double t) { return std::abs(t - middle) < kApart_s; });
      if (crowded || !accept(ahead(middle, random), 1.2, 1.0, "ahead", 8.0)) continue;
      taken.push_back(middle);
      break;
    }
  }
}

// --- across the vehicle's path at junctions

void TrafficPlanner::plan_crossing() {
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    const Visit& visit = visits_[i];
    Random choice = random_.part(20000 + i);
    if (!choice.chance(0.6)) continue;
    const simulated_world::Junction& junction = site_.roads.junctions[static_cast<std::size_t>(visit.junction)];
    const RoadNetwork::Nearest came_by = site_.roads.nearest_road(own(visit.entered_s - 3.0).centre);
    std::vector<int> sides;
    for (const int number : junction.roads) {
      const Road& road = site_.roads.roads[static_cast<std::size_t>(number)];
      if (number != came_by.road && road.from != road.to) {
        sides.push_back(road.from == visit.junction ? road.to : road.from);
      }
    }
    if (sides.size() < 2) continue;
    for (std::uint64_t attempt = 0; attempt < 12; ++attempt) {
      Random random = random_.part(21000 + 20 * i + attempt);
      const int from = random.below(static_cast<int>(sides.size()));
      const int to = (from + 1 + random.below(static_cast<int>(sides.size()) - 1)) % static_cast<int>(sides.size());
      std::vector<int> back{visit.junction, sides[static_cast<std::size_t>(from)]};
      walk_on(back, 2, random);
      std::vector<int> junctions(back.rbegin(), back.rend());
      junctions.push_back(sides[static_cast<std::size_t>(to)]);
      walk_on(junctions, 2, random);
      const double meeting = visit.entered_s - random.uniform(0.5, 4.0);
      if (accept(passing(junctions, junction.position, meeting, random.chance(0.2), random), 1.0, 0.6, "crossing",
                 22.0)) {
        break;
      }
    }
  }
}

// --- towards the vehicle, in the other lane

void TrafficPlanner::plan_oncoming() {
  std::uint64_t proposal = 30000;
  for (double t = 6.0; t < motion_.duration_s() - 3.0;) {
    bool found = false;
    for (int attempt = 0; attempt < 10 && !found; ++attempt) {
      Random random = random_.part(proposal++);
      const double meeting_s = t + random.uniform(-3.0, 3.0);
      const Footprint here = own(meeting_s);
      const RoadNetwork::Nearest nearest = site_.roads.nearest_road(here.centre);
      const Road& road = site_.roads.roads[static_cast<std::size_t>(nearest.road)];
      if (road.from == road.to) continue;
      const bool onwards = nearest.side_m < 0.0;
      const int ours = onwards ? road.to : road.from, theirs = onwards ? road.from : road.to;
      std::vector<int> back{theirs, ours};
      walk_on(back, 2, random);
      std::vector<int> junctions(back.rbegin(), back.rend());
      walk_on(junctions, 2, random);
      found =
          accept(passing(junctions, here.centre, meeting_s, random.chance(0.3), random), 0.55, 0.5, "oncoming", 12.0);
    }
    Random pause = random_.part(proposal++);
    t += found ? pause.uniform(10.0, 18.0) : 3.0;
  }
}

}  // namespace panvo::simulation

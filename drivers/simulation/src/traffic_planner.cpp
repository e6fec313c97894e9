// SPDX-License-Identifier: Apache-2.0
#include "traffic_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace panvo::simulation {

using simulated_world::Random;
using simulated_world::Road;
using simulated_world::RoadNetwork;

namespace {

using Eigen::Vector2d;

constexpr double kStep_s = 0.1;
constexpr double kOwnLength_m = 4.3, kOwnWidth_m = 1.85;
constexpr double kAbout_m = 75.0;        // movers exist within this distance
constexpr double kHidden_m = 42.0;       // smallest distance at which they may appear or vanish
constexpr double kLeastHidden_m = 26.0;  // the same for a mover ahead on our own winding road

Vector2d left_of(double heading) { return {-std::sin(heading), std::cos(heading)}; }
Vector2d along(double heading) { return {std::cos(heading), std::sin(heading)}; }

void measure(Mover& mover) {
  mover.along_m.assign(mover.path.size(), 0.0);
  for (std::size_t i = 1; i < mover.path.size(); ++i) {
    mover.along_m[i] = mover.along_m[i - 1] + (mover.path[i] - mover.path[i - 1]).norm();
  }
}

std::size_t nearest_index(const std::vector<Vector2d>& points, const Vector2d& point) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - point).squaredNorm() < (points[best] - point).squaredNorm()) best = i;
  }
  return best;
}

}  // namespace

TrafficPlanner::TrafficPlanner(const simulated_world::Site& site, const VehicleMotion& motion,
                               const simulated_world::MoverModels& models, std::uint64_t seed)
    : site_(site),
      motion_(motion),
      models_(models),
      random_(seed, "traffic"),
      visits_(find_visits(site.roads, motion)) {
  for (double t = 0.0; t <= motion.duration_s() + kStep_s; t += kStep_s) {
    const Eigen::Isometry3d pose = motion.world_from_base(t);
    own_.push_back({pose.translation().head<2>(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)), kOwnLength_m,
                    kOwnWidth_m});
  }
}

void TrafficPlanner::plan() {
  plan_ahead();
  plan_crossing();
  plan_oncoming();
  plan_road_crossers();
  plan_strollers();
  std::sort(episodes.begin(), episodes.end(), [](const auto& a, const auto& b) { return a.from_s < b.from_s; });
}

Footprint TrafficPlanner::own(double t_s) const {
  const double at = std::round(t_s / kStep_s);
  return own_[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(own_.size() - 1)))];
}

Footprint TrafficPlanner::of(const Mover& mover, double t_s) const {
  const auto [position, heading] = ground_place(mover, motion_, t_s);
  return {position, heading, mover.length_m, mover.width_m};
}

bool TrafficPlanner::keeps_clear(const Mover& mover, double of_vehicle_m, double of_movers_m) const {
  std::vector<const Mover*> others;
  for (const Mover& other : movers) {
    if (other.from_s < mover.to_s && mover.from_s < other.to_s && !(other.walks && mover.walks))
      others.push_back(&other);
  }
  const double first = std::ceil(std::max(0.0, mover.from_s) / kStep_s) * kStep_s;
  for (double t = first; t <= std::min(mover.to_s, motion_.duration_s()); t += kStep_s) {
    const Footprint here = of(mover, t);
    if (distance(here, own(t)) < of_vehicle_m) return false;
    for (const Mover* other : others) {
      if (t < other->from_s || t > other->to_s) continue;
      const Footprint there = of(*other, t);
      if ((there.centre - here.centre).norm() > 10.0) continue;
      if (distance(here, there) < of_movers_m) return false;
    }
  }
  return true;
}

bool TrafficPlanner::accept(const std::optional<Mover>& mover, double of_vehicle_m, double of_movers_m,
                            const char* kind, double episode_m) {
  if (!mover || !keeps_clear(*mover, of_vehicle_m, of_movers_m)) return false;
  if (kind != nullptr) {
    Traffic::Episode episode{std::numeric_limits<double>::infinity(), 0.0, kind};
    for (double t = std::max(0.0, mover->from_s); t <= std::min(mover->to_s, motion_.duration_s()); t += kStep_s) {
      if (distance(of(*mover, t), own(t)) > episode_m) continue;
      episode.from_s = std::min(episode.from_s, t);
      episode.to_s = t;
    }
    if (!(episode.from_s < episode.to_s)) return false;  // never near the vehicle
    episodes.push_back(episode);
  }
  movers.push_back(*mover);
  return true;
}

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

Mover TrafficPlanner::person(Random& random) const {
  Mover mover;
  mover.walks = true;
  mover.model = models_.people[static_cast<std::size_t>(random.below(static_cast<int>(models_.people.size())))];
  mover.length_m = mover.width_m = 0.6;
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

bool TrafficPlanner::live(Mover& mover, double at_m, double t_s) const {
  mover.from_s = t_s;
  mover.start_m = at_m;
  const Mover fixed = mover;
  const auto metres_off = [&](double t) { return (of(fixed, t).centre - own(t).centre).norm(); };
  const double starts = t_s - at_m / mover.speed_m_per_s;
  const double ends = t_s + (mover.along_m.back() - at_m) / mover.speed_m_per_s;
  double from = t_s, to = t_s;
  while (from > starts && from > -1.0 && metres_off(from) <= kAbout_m) from -= kStep_s;
  while (to < ends && to < motion_.duration_s() + 1.0 && metres_off(to) <= kAbout_m) to += kStep_s;
  mover.from_s = std::max(from, starts);
  mover.to_s = std::min(to, ends);
  mover.start_m = at_m - mover.speed_m_per_s * (t_s - mover.from_s);
  return (mover.from_s < 0.0 || metres_off(mover.from_s) > kHidden_m) &&
         (mover.to_s > motion_.duration_s() || metres_off(mover.to_s) > kHidden_m);
}

void TrafficPlanner::live_waiting(Mover& mover, double at_m, double t_s) const {
  mover.from_s = t_s;
  mover.start_m = at_m;
  const Mover fixed = mover;
  const auto near = [&](double t) { return (of(fixed, t).centre - own(t).centre).norm() <= kHidden_m; };
  double from = t_s, to = t_s;
  while (from > -1.0 && near(from)) from -= kStep_s;
  while (to < motion_.duration_s() + 1.0 && near(to)) to += kStep_s;
  mover.from_s = from;
  mover.to_s = to;
  mover.start_m = at_m - mover.speed_m_per_s * (t_s - from);
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
  mover.from_s = mover.near_from_s - (mover.far_m - mover.near_m) / 1.9;
  mover.to_s = mover.near_to_s + (mover.far_m - mover.near_m) / 3.2;

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
    if (is_seen && (of(mover, t).centre - own(t).centre).norm() < kLeastHidden_m) return std::nullopt;
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

// --- on foot

// A pedestrian who crosses the road in front of the vehicle, and is in the middle of its lane when the vehicle is 6 to
// 10 m away.
std::optional<Mover> TrafficPlanner::road_crosser(double t_s, Random random) const {
  const double gap = 0.5 * kOwnLength_m + random.uniform(6.0, 10.0);
  const double at_m = motion_.travelled_m(t_s) + gap;
  const DrivenPath& path = motion_.path();
  if (motion_.speed_m_per_s(t_s) < 2.0 || at_m + 5.0 > path.along_m.back()) return std::nullopt;
  const auto i = static_cast<std::size_t>(std::lower_bound(path.along_m.begin(), path.along_m.end() - 1, at_m) -
                                          path.along_m.begin());
  const RoadNetwork::Nearest nearest = site_.roads.nearest_road(path.points[i]);
  const Road& road = site_.roads.roads[static_cast<std::size_t>(nearest.road)];
  const Vector2d way = (path.points[i] - path.points[i - 1]).normalized();
  const double heading = std::atan2(way.y(), way.x());
  const Vector2d middle = path.points[i] + std::abs(nearest.side_m) * left_of(heading);
  const double half = 0.5 * road.width_m + 1.1;
  const double side = random.chance(0.5) ? 1.0 : -1.0;  // side on which the pedestrian starts
  const double before = random.chance(0.5) ? 1.0 : -1.0, after = random.chance(0.5) ? 1.0 : -1.0;

  Mover mover = person(random);
  mover.speed_m_per_s = random.uniform(1.4, 1.9);
  // along the pavement, around a corner, across, around a corner, along the other pavement
  constexpr double kWalk_m = 25.0, kRound_m = 1.0;
  const Vector2d a = middle + side * half * left_of(heading), b = middle - side * half * left_of(heading);
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

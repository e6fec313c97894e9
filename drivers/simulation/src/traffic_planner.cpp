// SPDX-License-Identifier: Apache-2.0
#include "traffic_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace panvo::simulation {

namespace {

constexpr double kPlanStep_s = 0.1;
constexpr double kOwnWidth_m = 1.85;
constexpr double kAbout_m = 75.0;   // movers exist within this distance
constexpr double kHidden_m = 42.0;  // smallest distance at which they may appear or vanish

}  // namespace

void measure(Mover& mover) {
  mover.along_m.assign(mover.path.size(), 0.0);
  for (std::size_t i = 1; i < mover.path.size(); ++i) {
    mover.along_m[i] = mover.along_m[i - 1] + (mover.path[i] - mover.path[i - 1]).norm();
  }
}

TrafficPlanner::TrafficPlanner(const simulated_world::Site& site, const VehicleMotion& motion,
                               const simulated_world::MoverModels& models, std::uint64_t seed)
    : site_(site),
      motion_(motion),
      models_(models),
      random_(seed, "traffic"),
      visits_(find_visits(site.roads, motion)) {
  for (double t = 0.0; t <= motion.duration_s() + kPlanStep_s; t += kPlanStep_s) {
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
  const double at = std::round(t_s / kPlanStep_s);
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
  const double first = std::ceil(std::max(0.0, mover.from_s) / kPlanStep_s) * kPlanStep_s;
  for (double t = first; t <= std::min(mover.to_s, motion_.duration_s()); t += kPlanStep_s) {
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
    for (double t = std::max(0.0, mover->from_s); t <= std::min(mover->to_s, motion_.duration_s()); t += kPlanStep_s) {
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

bool TrafficPlanner::live(Mover& mover, double at_m, double t_s) const {
  mover.from_s = t_s;
  mover.start_m = at_m;
  const Mover fixed = mover;
  const auto metres_off = [&](double t) { return (of(fixed, t).centre - own(t).centre).norm(); };
  const double starts = t_s - at_m / mover.speed_m_per_s;
  const double ends = t_s + (mover.along_m.back() - at_m) / mover.speed_m_per_s;
  double from = t_s, to = t_s;
  while (from > starts && from > -1.0 && metres_off(from) <= kAbout_m) from -= kPlanStep_s;
  while (to < ends && to < motion_.duration_s() + 1.0 && metres_off(to) <= kAbout_m) to += kPlanStep_s;
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
  while (from > -1.0 && near(from)) from -= kPlanStep_s;
  while (to < motion_.duration_s() + 1.0 && near(to)) to += kPlanStep_s;
  mover.from_s = from;
  mover.to_s = to;
  mover.start_m = at_m - mover.speed_m_per_s * (t_s - from);
}

}  // namespace panvo::simulation

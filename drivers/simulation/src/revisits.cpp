// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/revisits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace panvo::simulation {

namespace {

constexpr double kStep_s = 0.05;  // a quarter of a metre

Eigen::Vector2d position_at(const VehicleMotion& motion, double t_s) {
  return motion.world_from_base(t_s).translation().head<2>();
}

double heading_at(const VehicleMotion& motion, double t_s) {
  const Eigen::Matrix3d rotation = motion.world_from_base(t_s).linear();
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

// The time at which the distance equals `radius_m`, between two instants on either side; to a microsecond.
double passing(const VehicleMotion& motion, const Eigen::Vector2d& centre, double radius_m, double from_s,
               double to_s) {
  const auto inside = [&](double t_s) { return (position_at(motion, t_s) - centre).norm() <= radius_m; };
  const bool at_first = inside(from_s);
  while (to_s - from_s > 1e-6) {
    const double middle = 0.5 * (from_s + to_s);
    (inside(middle) == at_first ? from_s : to_s) = middle;
  }
  return 0.5 * (from_s + to_s);
}

// The time of closest approach, within a step around the nearest sample; by ternary search, to about 10 microseconds.
double nearest(const VehicleMotion& motion, const Eigen::Vector2d& centre, double about_s) {
  const auto distance = [&](double t_s) { return (position_at(motion, t_s) - centre).norm(); };
  double from = about_s - kStep_s, to = about_s + kStep_s;
  for (int i = 0; i < 25; ++i) {
    const double a = from + (to - from) / 3.0, b = to - (to - from) / 3.0;
    (distance(a) < distance(b) ? to : from) = distance(a) < distance(b) ? b : a;
  }
  return 0.5 * (from + to);
}

}  // namespace

std::vector<Visit> find_visits(const simulated_world::RoadNetwork& roads, const VehicleMotion& motion,
                               double radius_m) {
  std::vector<Eigen::Vector2d> track;
  const auto samples = static_cast<std::size_t>(motion.duration_s() / kStep_s) + 1;
  for (std::size_t i = 0; i < samples; ++i) track.push_back(position_at(motion, kStep_s * static_cast<double>(i)));

  std::vector<Visit> visits;
  for (std::size_t number = 0; number < roads.junctions.size(); ++number) {
    const simulated_world::Junction& junction = roads.junctions[number];
    if (!junction.is_crossing()) continue;
    const auto distance = [&](std::size_t i) { return (track[i] - junction.position).norm(); };
    for (std::size_t i = 1; i < samples; ++i) {
      if (distance(i - 1) <= radius_m || distance(i) > radius_m) continue;
      std::size_t closest = i, out = i;
      for (; out < samples && distance(out) <= radius_m; ++out) {
        if (distance(out) < distance(closest)) closest = out;
      }
      if (out == samples) break;  // the journey ends here: not a pass
      const auto time = [](std::size_t k) { return kStep_s * static_cast<double>(k); };
      Visit visit;
      visit.junction = static_cast<int>(number);
      visit.entered_s = passing(motion, junction.position, radius_m, time(i - 1), time(i));
      visit.left_s = passing(motion, junction.position, radius_m, time(out - 1), time(out));
      visit.closest_s = nearest(motion, junction.position, time(closest));
      visit.travelled_m = motion.travelled_m(visit.closest_s);
      visit.position = position_at(motion, visit.closest_s);
      visit.closest_m = (visit.position - junction.position).norm();
      visit.heading_entered_rad = heading_at(motion, visit.entered_s);
      visit.heading_closest_rad = heading_at(motion, visit.closest_s);
      visit.heading_left_rad = heading_at(motion, visit.left_s);
      visits.push_back(visit);
      i = out;
    }
  }
  std::sort(visits.begin(), visits.end(), [](const Visit& a, const Visit& b) { return a.entered_s < b.entered_s; });
  return visits;
}

std::vector<Revisit> find_revisits(const std::vector<Visit>& visits) {
  std::vector<Revisit> revisits;
  std::map<int, std::size_t> first;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const auto [known, is_new] = first.try_emplace(visits[i].junction, i);
    if (is_new) continue;
    const Visit& then = visits[known->second];
    double angle = std::remainder(visits[i].heading_entered_rad - then.heading_entered_rad, 2.0 * std::numbers::pi);
    if (angle <= -std::numbers::pi) angle = std::numbers::pi;
    revisits.push_back(
        {static_cast<int>(i), static_cast<int>(known->second), angle, (visits[i].position - then.position).norm()});
  }
  return revisits;
}

}  // namespace panvo::simulation

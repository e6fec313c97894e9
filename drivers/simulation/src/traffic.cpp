// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "smooth_step.hpp"
#include "traffic_planner.hpp"

namespace panvo::simulation {

using simulated_world::MovingPlacement;

namespace {

constexpr double kSight_m = 180.0;  // movers farther away are omitted

double metres_ahead(const Mover& mover, double t_s) {
  const double coming = smooth_step((t_s - mover.from_s) / (mover.near_from_s - mover.from_s));
  const double leaving = smooth_step((t_s - mover.near_to_s) / (mover.to_s - mover.near_to_s));
  return mover.far_m + (mover.near_m - mover.far_m) * (coming - leaving);
}

}  // namespace

GroundPlace ground_place(const Mover& mover, const VehicleMotion& motion, double t_s) {
  const double along = mover.keeps_ahead ? motion.travelled_m(t_s) + metres_ahead(mover, t_s)
                                         : mover.start_m + mover.speed_m_per_s * (t_s - mover.from_s);
  const double inside = std::clamp(along, 0.0, mover.along_m.back());
  const auto after = std::upper_bound(mover.along_m.begin() + 1, mover.along_m.end() - 1, inside);
  const auto i = static_cast<std::size_t>(after - mover.along_m.begin());
  const Eigen::Vector2d step = mover.path[i] - mover.path[i - 1];
  const double share = (inside - mover.along_m[i - 1]) / (mover.along_m[i] - mover.along_m[i - 1]);
  // interpolated between the directions at both points, for smooth turns
  const Eigen::Vector2d next = i + 1 < mover.path.size() ? Eigen::Vector2d(mover.path[i + 1] - mover.path[i]) : step;
  const Eigen::Vector2d way = (1.0 - share) * step.normalized() + share * next.normalized();
  return {mover.path[i - 1] + share * step, std::atan2(way.y(), way.x())};
}

Traffic::Traffic(const simulated_world::Site& site, const VehicleMotion& motion,
                 const simulated_world::MoverModels& models, std::uint64_t seed)
    : motion_(&motion), site_(&site) {
  if (models.cars.empty() || models.vans.empty() || models.people.empty()) {
    throw std::invalid_argument("traffic: needs models of cars, vans and people");
  }
  TrafficPlanner planner(site, motion, models, seed);
  planner.plan();
  movers_ = std::move(planner.movers);
  episodes_ = std::move(planner.episodes);
}

std::vector<MovingPlacement> Traffic::at(double opened_s, double closed_s) const {
  const Eigen::Vector2d here = motion_->world_from_base(opened_s).translation().head<2>();
  std::vector<MovingPlacement> placements;
  for (const Mover& mover : movers_) {
    if (opened_s < mover.from_s || opened_s > mover.to_s) continue;
    if ((ground_place(mover, *motion_, opened_s).position - here).norm() > kSight_m) continue;
    MovingPlacement placement;
    placement.at_opening.model = mover.model;
    placement.at_opening.tint = mover.tint;
    placement.at_opening.world_from_model = place(mover, opened_s);
    placement.world_from_model_closed = place(mover, closed_s);
    placements.push_back(placement);
  }
  return placements;
}

Eigen::Affine3f Traffic::place(const Mover& mover, double t_s) const {
  const auto [position, heading] = ground_place(mover, *motion_, t_s);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  if (mover.walks) {
    constexpr double kPhasePerMetre = 4.2, kBob_m = 0.02, kSway_rad = 0.06;  // a step every 0.75 m
    const double along = mover.start_m + mover.speed_m_per_s * (t_s - mover.from_s);
    const double phase = kPhasePerMetre * std::clamp(along, 0.0, mover.along_m.back());
    pose.translation() << position, site_->ground_m(position) + kBob_m * std::abs(std::sin(phase));
    pose.linear() = pose.linear() * Eigen::AngleAxisd(kSway_rad * std::sin(phase), Eigen::Vector3d::UnitZ());
    return pose.cast<float>();
  }
  const Eigen::Vector2d half = 0.3 * mover.length_m * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  const Eigen::Vector2d aside = 0.4 * mover.width_m * Eigen::Vector2d(-std::sin(heading), std::cos(heading));
  const auto height = [&](const Eigen::Vector2d& point) { return site_->terrain.height_m(point); };
  const double nose_up = std::atan2(height(position + half) - height(position - half), 2.0 * half.norm());
  const double left_up = std::atan2(height(position + aside) - height(position - aside), 2.0 * aside.norm());
  pose.translation() << position, 0.5 * (height(position + half) + height(position - half));
  pose.linear() = pose.linear() * Eigen::AngleAxisd(-nose_up, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(left_up, Eigen::Vector3d::UnitX());
  return pose.cast<float>();
}

}  // namespace panvo::simulation

// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/sighting_run.hpp"

#include <cmath>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::stereo_places {
namespace {

constexpr double kForget_m = 15.0;
constexpr double kDriftRatio = 0.03;
constexpr double kWayPerTurn_m = 1.0 / (10.0 * vision::kDegree);  // per rad

double turn_of(const Eigen::Isometry3d& motion) { return vision::so3_log(motion.linear()).norm(); }

}  // namespace

void SightingRun::add(const Sighting& sighting, const PoseOf& pose_of) {
  if (agrees(sighting, pose_of)) {
    ++count_;
    const double turn_rad = turn_of(last_->odom_from_base.inverse() * sighting.odom_from_base);
    progress_m_ += std::abs(sighting.way_m - last_->way_m) + kWayPerTurn_m * turn_rad;
  } else {
    count_ = 1;
    progress_m_ = 0.0;
  }
  last_ = sighting;
}

bool SightingRun::agrees(const Sighting& sighting, const PoseOf& pose_of) const {
  if (!last_ || std::abs(sighting.way_m - last_->way_m) > kForget_m) return false;
  const auto before = pose_of(last_->landmark_id);
  const auto now = pose_of(sighting.landmark_id);
  if (!before || !now) return false;
  const Eigen::Isometry3d carried =
      *before * last_->landmark_from_base * last_->odom_from_base.inverse() * sighting.odom_from_base;
  const Eigen::Isometry3d apart = carried.inverse() * *now * sighting.landmark_from_base;
  const double max_m = parameters_.agree_m + kDriftRatio * std::abs(sighting.way_m - last_->way_m);
  return apart.translation().norm() < max_m && turn_of(apart) < parameters_.agree_deg * vision::kDegree;
}

bool SightingRun::is_confirmed(bool is_located) const {
  return is_located ? count_ >= parameters_.sightings && progress_m_ >= parameters_.way_m
                    : count_ >= parameters_.unlocated_sightings && progress_m_ >= parameters_.unlocated_way_m;
}

std::optional<std::uint32_t> SightingRun::landmark(double way_m) const {
  if (!last_ || std::abs(way_m - last_->way_m) > kForget_m) return std::nullopt;
  return last_->landmark_id;
}

}  // namespace panvo::stereo_places

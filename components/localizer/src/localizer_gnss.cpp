// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>
#include <utility>

#include "panvo/localizer/localizer.hpp"

/// Processing of positions by satellites.
namespace panvo::localizer {

FixOutcome Localizer::add(const GnssFix& received) {
  const auto at = chain_.at(received.stamp_ns);
  if (!at) return {FixUse::kRejected, "no odometry stored for that time"};
  if (last_fix_at_way_m_ && at->way_m - *last_fix_at_way_m_ < parameters_.gnss.spacing_m)
    return {FixUse::kTooClose, {}};
  last_fix_at_way_m_ = at->way_m;
  GnssFix fix = received;
  if (const auto twist = chain_.twist(fix.stamp_ns)) fix.velocity_in_base_m_s = twist->head<3>();
  if (!graph_.has_enu()) return try_fixes({fix, *at}, parameters_.gnss.trial_m);
  if (!is_expected(fix, *at)) {
    // If all of them are off for long, it is not by reflections: the map was moved on earth, or the satellites' frame.
    auto outcome = try_fixes({fix, *at}, parameters_.gnss.doubt_m);
    if (outcome.use == FixUse::kOnTrial) outcome = {FixUse::kRejected, "contradicts the pose"};
    return outcome;
  }
  fix_trial_.clear();
  LocalPoseGraph corrected = graph_;
  corrected.add_fix(fix, *at);
  if (!corrected.solve()) return {FixUse::kRejected, "the pose graph could not be solved"};
  graph_ = std::move(corrected);
  check_.add_correction(at->pose.stamp_ns);
  latest_ = localized(chain_.latest());
  return {FixUse::kUsed, {}};
}

PoseInMap Localizer::latest_in_enu() const {
  PoseInMap pose = graph_.in_enu(chain_.latest());
  pose.covariance += by_time(chain_.latest(), set_back_s_);
  return pose;
}

/// Begins the use of fixes if those on trial have the shape of the odometry's path.
FixOutcome Localizer::try_fixes(const GnssTrial::Sample& sample, double least_m) {
  fix_trial_.refresh(chain_);
  fix_trial_.add(sample, least_m);
  const auto result = fix_trial_.result(least_m);
  if (!result) return {FixUse::kOnTrial, {}};
  if (!result->agrees) return {FixUse::kOnTrial, result->reason};
  LocalPoseGraph corrected = graph_;
  const Eigen::Isometry3d map_from_odom =
      graph_.carried(sample.at).map_from_base * sample.at.pose.odom_from_base.inverse();
  // Landmarks that were seen tell more than the satellites of an earlier journey.
  const bool locates = known_enu_ && graph_.has_known() && !(is_located_ && is_joined_);
  if (locates) {
    const Eigen::Isometry3d placed = known_enu_->map_from_base * result->odom_from_enu.inverse();
    corrected.place(placed * map_from_odom.inverse());
    corrected.set_enu(known_enu_->map_from_base, known_enu_->covariance);
  } else {
    corrected.set_enu(map_from_odom * result->odom_from_enu, std::nullopt);
  }
  // Also those of before the stored odometry: a slow vehicle needs minutes for the path of a trial.
  for (const auto& one : fix_trial_.samples()) corrected.add_fix(one.fix, one.at);
  if (!corrected.solve()) return {FixUse::kOnTrial, "the pose graph could not be solved"};
  graph_ = std::move(corrected);
  fix_trial_.clear();
  check_.add_correction(sample.at.pose.stamp_ns);
  if (locates) {
    is_located_ = is_joined_ = true;
    found_at_way_m_ = sample.at.way_m;
  }
  latest_ = localized(chain_.latest());
  return {FixUse::kBegun, {}};
}

bool Localizer::is_expected(const GnssFix& fix, const OdometrySample& at) const {
  const auto here = graph_.in_enu(at);
  const auto delay = graph_.fix_delay();
  const Eigen::Matrix3d& turned = here.map_from_base.linear();
  const Eigen::Vector3d arm = turned * (fix.antenna_in_base_m - delay.value * fix.velocity_in_base_m_s);
  const Eigen::Vector3d by_delay = delay.sigma * (turned * fix.velocity_in_base_m_s);
  const Eigen::Vector3d error = fix.enu_m - here.map_from_base.translation() - arm;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << Eigen::Matrix3d::Identity(), -vision::skew(arm);
  const Eigen::Matrix3d spread =
      fix.covariance + by_pose * here.covariance * by_pose.transpose() + by_delay * by_delay.transpose();
  return error.dot(spread.ldlt().solve(error)) <= parameters_.gnss.gate_chi_square;
}

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
// What is left of a fusion after the stereo odometry's clock was set back.
#include <utility>

#include "panvo/odometry_fusion/odometry_fusion.hpp"
#include "panvo/vision/step_covariance.hpp"

namespace panvo::odometry_fusion {

bool OdometryFusion::begin_again(const StereoPose& stereo, int refused) {
  OdometryFusion again(parameters_);
  if (!again.add(stereo)) return false;
  again.begin_ = latest_ ? continued(stereo, refused) : begin_;
  again.interval_ = interval_;
  *this = std::move(again);
  return true;
}

/// Where the path leads at a stereo pose whose stamp does not tell the time since the last.
OdometryFusion::Begin OdometryFusion::continued(const StereoPose& stereo, int refused) const {
  const double time_s = interval_.median_s() * (refused + 1 + static_cast<int>(waiting_.size()));
  const StereoPose& last = *previous_stereo_;
  const Eigen::Isometry3d& odom_from_last = latest_->odom_from_base;
  if (last.stamp_ns == latest_->stamp_ns && path_.goes_on(time_s, stereo.odom_from_base, stereo.covariance)) {
    const Eigen::Isometry3d seen = last.odom_from_base.inverse() * stereo.odom_from_base;
    const vision::Matrix6d gained =
        vision::step_covariance(last.odom_from_base, last.covariance, stereo.odom_from_base, stereo.covariance);
    return {odom_from_last * seen, vision::compose_covariance(odom_from_last, latest_->covariance, seen, gained)};
  }
  return {odom_from_last, vision::after_unknown_motion(latest_->covariance, latest_->twist, time_s)};
}

}  // namespace panvo::odometry_fusion

// SPDX-License-Identifier: Apache-2.0
#include "vehicle_motion.hpp"

#include <utility>

namespace panvo::binocular_odometry {

VehicleEstimate VehicleMotion::estimate(const RigFrame& seen) {
  if (!current_) current_ = leg_of(seen.rig);
  if (seen.rig == current_->rig) return on_vehicle(*current_, current_->stage.estimate(seen.frame));

  if (!next_ || next_->rig != seen.rig) next_ = leg_of(seen.rig);
  const bool has_started = next_->stage.estimate(seen.frame).quality.reliable;
  TrackedFrame unseen = seen.frame;
  if (unseen.fault.empty()) unseen.fault = "the calibration of the cameras changed";
  const VehicleEstimate predicted = on_vehicle(*current_, current_->stage.estimate(unseen));
  if (!has_started) return predicted;
  next_->odom_from_start = predicted.odom_from_base;
  current_ = std::exchange(next_, std::nullopt);
  return predicted;
}

VehicleMotion::Leg VehicleMotion::leg_of(const std::shared_ptr<const StereoRig>& rig) const {
  return {rig, MotionStage(rig->stereo, parameters_, observer_)};
}

VehicleEstimate VehicleMotion::on_vehicle(const Leg& leg, OdometryEstimate estimate) {
  const auto& mount = leg.rig->base_from_left;
  UncertainPose here = motion_of_base(mount, estimate.odom_from_left, estimate.odom_from_left_covariance);
  if (const auto& start = leg.odom_from_start) {
    here.covariance = vision::compose_covariance(start->pose, start->covariance, here.pose, here.covariance);
    here.pose = start->pose * here.pose;
  }
  const UncertainPose step =
      motion_of_base(mount, estimate.previous_from_current, estimate.previous_from_current_covariance);
  return {std::move(estimate), std::move(here), step};
}

}  // namespace panvo::binocular_odometry

// SPDX-License-Identifier: Apache-2.0
// What is left of an odometry after the stereo odometry's clock was set back.
#include <utility>

#include "panvo/all_round_odometry/all_round_odometry.hpp"
#include "panvo/vision/step_covariance.hpp"

namespace panvo::all_round_odometry {

void AllRoundOdometry::begin_again(const StereoPose& stereo, int refused) {
  AllRoundOdometry again(parameters_, base_from_camera_);
  again.camera_rotation_ = camera_rotation_;
  again.shift_ = continued(stereo, refused);
  again.interval_ = interval_;
  *this = std::move(again);
  add(stereo);
}

/// The shift by which the path goes on at a stereo pose whose stamp does not tell the time since the last.
auto AllRoundOdometry::continued(const StereoPose& stereo, int refused) const -> std::optional<Shift> {
  if (stereo_.empty()) return shift_;
  const double time_s = interval_.median_s() * (refused + 1);
  const bool is_same_path = path_.goes_on(time_s, stereo.odom_from_base, stereo.covariance);
  const Pose now{stereo.odom_from_base, stereo.covariance};
  const auto there = blind_ ? stereo_.at(last_->stamp_ns) : std::nullopt;
  if (is_same_path && there) return Shift{*there, last_->odometry};
  // While its poses were refused, the stereo odometry went on.
  if (is_same_path || emitted_ns_ == INT64_MIN) return shift_;
  const vision::Vector6d twist = blind_ ? twist_ : path_.velocity();  // panoramas may have shown none
  return Shift{now, {emitted_.odom_from_base, vision::after_unknown_motion(emitted_.covariance, twist, time_s)}};
}

}  // namespace panvo::all_round_odometry

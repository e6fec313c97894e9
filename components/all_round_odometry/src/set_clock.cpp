// SPDX-License-Identifier: Apache-2.0
// What is left of an odometry after the stereo odometry's clock was set back.
#include <cmath>
#include <utility>

#include "panvo/all_round_odometry/all_round_odometry.hpp"
#include "panvo/vision/same_path.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::all_round_odometry {

void AllRoundOdometry::begin_again(const StereoPose& stereo, int refused) {
  AllRoundOdometry again(parameters_, base_from_camera_);
  again.camera_rotation_ = camera_rotation_;
  again.shift_ = continued(stereo, refused);
  *this = std::move(again);
  add(stereo);
}

/// The shift by which the path goes on at a stereo pose whose stamp does not tell the time since the last.
auto AllRoundOdometry::continued(const StereoPose& stereo, int refused) const -> std::optional<Shift> {
  if (stereo_.empty()) return shift_;
  const StereoPose& last = stereo_.back();
  const double usual_s = vision::seconds(stereo_.front().stamp_ns, last.stamp_ns) / static_cast<double>(stereo_.size());
  const double time_s = usual_s * (refused + 1);
  const bool is_same_path = vision::is_same_path(last.odom_from_base, last.covariance, stereo.odom_from_base,
                                                 stereo.covariance, time_s, kMaxSpeed);
  const Pose now{stereo.odom_from_base, stereo.covariance};
  if (is_same_path && blind_) return Shift{stereo_at(last_->stamp_ns).value_or(now), last_->odometry};
  if (is_same_path || emitted_ns_ == INT64_MIN) return shift_;
  Pose here = emitted_;  // the motion since is unknown
  here.covariance.diagonal().head<3>().array() += std::pow(time_s * twist_.head<3>().norm(), 2);
  here.covariance.diagonal().tail<3>().array() += std::pow(time_s * twist_.tail<3>().norm(), 2);
  return Shift{now, here};
}

}  // namespace panvo::all_round_odometry

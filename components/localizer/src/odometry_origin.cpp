// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/odometry_origin.hpp"

#include <fmt/format.h>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/reach.hpp"
#include "panvo/vision/seconds.hpp"

namespace panvo::localizer {

OdometryOrigin::Taken OdometryOrigin::take(const OdometryPose& received) {
  const Place here{received.stamp_ns, received.odom_from_base};
  Taken taken;
  if (last_ && !is_within_reach(*last_, here)) {
    const bool agrees = elsewhere_ && is_within_reach(*elsewhere_, here);
    run_ = agrees ? run_ + 1 : 1;
    elsewhere_ = here;
    if (run_ < kRun) {
      taken.reason = fmt::format("moves faster than fusion.max_speed_m_s ({:.0f} m/s)", max_speed_m_s_);
      return taken;
    }
    odom_from_received_ = latest_.odom_from_base * received.odom_from_base.inverse();
    covariance_before_ = latest_.covariance;
    taken.is_new_origin = true;
  }
  last_ = here;
  elsewhere_.reset();
  run_ = 0;
  latest_ = continued(received);
  if (taken.is_new_origin) latest_.is_reliable = false;
  taken.odometry = latest_;
  return taken;
}

void OdometryOrigin::set_clock_back(std::int64_t by_ns) {
  if (last_) last_->stamp_ns -= by_ns;
  if (elsewhere_) elsewhere_->stamp_ns -= by_ns;
  latest_.stamp_ns -= by_ns;
}

bool OdometryOrigin::is_within_reach(const Place& from, const Place& to) const {
  return vision::is_within_reach(from.odom_from_base, to.odom_from_base, vision::seconds(from.stamp_ns, to.stamp_ns),
                                 max_speed_m_s_);
}

OdometryPose OdometryOrigin::continued(const OdometryPose& received) const {
  if (!odom_from_received_) return received;
  OdometryPose odometry = received;
  odometry.odom_from_base = *odom_from_received_ * received.odom_from_base;
  odometry.covariance =
      covariance_before_ + vision::rotate_covariance(odom_from_received_->linear(), received.covariance);
  return odometry;
}

}  // namespace panvo::localizer

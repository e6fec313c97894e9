// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/odometry_origin.hpp"

#include <fmt/format.h>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/step_covariance.hpp"

namespace panvo::localizer {

OdometryOrigin::Taken OdometryOrigin::take(const OdometryPose& received) {
  Taken taken;
  switch (path_.add(received.stamp_ns, received.odom_from_base, received.covariance, received.is_reliable)) {
    case vision::OnPath::kGoesOn:
      latest_ = continued(received);
      break;
    case vision::OnPath::kElsewhere:
      taken.reason = path_.reaches(received.stamp_ns, received.odom_from_base)
                         ? "seems to begin at another origin"
                         : fmt::format("moves faster than fusion.max_speed_m_s ({:.0f} m/s)", max_speed_m_s_);
      return taken;
    case vision::OnPath::kRestarted:
      begin_anew(received);
      taken.is_new_origin = true;
      break;
  }
  taken.odometry = latest_;
  return taken;
}

void OdometryOrigin::set_clock_back(std::int64_t by_ns) {
  path_.set_clock_back(by_ns);
  latest_.stamp_ns -= by_ns;
}

/// In the gap, the vehicle is assumed to have moved as fast as before and after it, on the mean.
void OdometryOrigin::begin_anew(const OdometryPose& received) {
  const Eigen::Isometry3d& moved = path_.motion_to_restart();
  OdometryPose continued = received;
  continued.odom_from_base = latest_.odom_from_base * moved;
  continued.covariance =
      vision::compose_covariance(latest_.odom_from_base, latest_.covariance, moved, vision::Matrix6d::Zero());
  continued.is_reliable = false;
  shift_ = Shift{received, continued};
  latest_ = continued;
}

OdometryPose OdometryOrigin::continued(const OdometryPose& received) const {
  if (!shift_) return received;
  const auto& [begin, begun] = *shift_;
  const Eigen::Isometry3d moved = begin.odom_from_base.inverse() * received.odom_from_base;
  const vision::Matrix6d gained =
      vision::step_covariance(begin.odom_from_base, begin.covariance, received.odom_from_base, received.covariance);
  OdometryPose odometry = received;
  odometry.odom_from_base = begun.odom_from_base * moved;
  odometry.covariance = vision::compose_covariance(begun.odom_from_base, begun.covariance, moved, gained);
  return odometry;
}

}  // namespace panvo::localizer

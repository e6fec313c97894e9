// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/odometry_origin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/reach.hpp"
#include "panvo/vision/seconds.hpp"
#include "panvo/vision/step_covariance.hpp"

namespace panvo::localizer {
namespace {

constexpr double kClearly = 0.25;   // fraction of a variance: half of the standard deviation
constexpr double kArm_m = 1.0;      // converts an angle to a distance: of a point beside the vehicle's origin
constexpr double kBase_s = 0.1;     // over which a velocity is measured: stamps jitter by milliseconds
constexpr double kCarries_s = 5.0;  // after that, a vehicle may as well have stopped

double apart_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (b.translation() - a.translation()).norm() +
         kArm_m * vision::so3_log(a.linear().transpose() * b.linear()).norm();
}

/// Of the horizontal position and the yaw: tilt and height may be known from another sensor, such as an accelerometer.
bool is_clearly_smaller(const vision::Matrix6d& covariance, const vision::Matrix6d& than) {
  const auto place = [](const vision::Matrix6d& of) { return of.topLeftCorner<2, 2>().trace(); };
  const auto yaw = [](const vision::Matrix6d& of) { return of(vision::kYaw, vision::kYaw); };
  return place(covariance) <= place(than) && yaw(covariance) <= yaw(than) &&
         (place(covariance) < kClearly * place(than) || yaw(covariance) < kClearly * yaw(than));
}

}  // namespace

OdometryOrigin::Taken OdometryOrigin::take(const OdometryPose& received) {
  const Place here{received.stamp_ns, received.odom_from_base};
  Taken taken;
  if (recent_.empty() || goes_on(here, received.covariance)) {
    accept(received);
  } else {
    if (!elsewhere_.empty() && !is_within_reach(elsewhere_.back(), here)) elsewhere_.clear();
    elsewhere_.push_back(here);
    if (elsewhere_.size() < kRun) {
      taken.reason = is_within_reach(recent_.back(), here)
                         ? "seems to begin at another origin"
                         : fmt::format("moves faster than fusion.max_speed_m_s ({:.0f} m/s)", max_speed_m_s_);
      return taken;
    }
    begin_anew(received);
    taken.is_new_origin = true;
  }
  taken.odometry = latest_;
  return taken;
}

void OdometryOrigin::set_clock_back(std::int64_t by_ns) {
  for (auto* places : {&recent_, &elsewhere_}) {
    for (auto& place : *places) place.stamp_ns -= by_ns;
  }
  latest_.stamp_ns -= by_ns;
}

/// Keeps as few places as show the velocity.
void OdometryOrigin::accept(const OdometryPose& received) {
  const Place here{received.stamp_ns, received.odom_from_base};
  shrinks_ |= !recent_.empty() && is_clearly_smaller(received.covariance, reliable_covariance_) &&
              !is_within_reach({recent_.back().stamp_ns, Eigen::Isometry3d::Identity()}, here);
  elsewhere_.clear();
  recent_.push_back(here);
  const auto is_base = [&](const Place& place) { return vision::seconds(place.stamp_ns, here.stamp_ns) >= kBase_s; };
  const auto shorter = std::find_if_not(recent_.begin(), recent_.end() - 1, is_base);
  if (shorter != recent_.begin()) recent_.erase(recent_.begin(), shorter - 1);
  latest_ = continued(received);
  if (received.is_reliable) reliable_covariance_ = received.covariance;
}

/// In the gap, the vehicle is assumed to have moved as fast as before and after it, on the mean.
void OdometryOrigin::begin_anew(const OdometryPose& received) {
  const double gap_s = std::min(vision::seconds(recent_.back().stamp_ns, received.stamp_ns), kCarries_s);
  const Eigen::Isometry3d moved = vision::se3_exp(0.5 * gap_s * (velocity(recent_) + velocity(elsewhere_)));
  OdometryPose continued = received;
  continued.odom_from_base = latest_.odom_from_base * moved;
  continued.covariance =
      vision::compose_covariance(latest_.odom_from_base, latest_.covariance, moved, vision::Matrix6d::Zero());
  continued.is_reliable = false;
  shift_ = Shift{received, continued};
  latest_ = continued;
  recent_ = std::exchange(elsewhere_, {});
  reliable_covariance_ = received.covariance;
}

/// Whether a pose continues the motion. The longer messages are rejected, the more a vehicle can reach, so that those
/// at another place are compared, too.
bool OdometryOrigin::goes_on(const Place& here, const vision::Matrix6d& covariance) const {
  if (!is_within_reach(recent_.back(), here) || begins(here, covariance)) return false;
  if (elsewhere_.empty() || !is_within_reach(elsewhere_.back(), here)) return true;
  const auto speed = [&](const Place& from) {
    return apart_m(from.odom_from_base, here.odom_from_base) / vision::seconds(from.stamp_ns, here.stamp_ns);
  };
  return speed(elsewhere_.back()) >= speed(recent_.back());
}

/// Whether an odometry seems to begin. The covariance of one that only integrates never shrinks. If another one's does,
/// as it closes a loop or states the error of each step, its pose is where the motion leads rather than at its origin.
bool OdometryOrigin::begins(const Place& here, const vision::Matrix6d& covariance) const {
  if (shrinks_ || !is_clearly_smaller(covariance, reliable_covariance_)) return false;
  const double gap_s = std::min(vision::seconds(recent_.back().stamp_ns, here.stamp_ns), kCarries_s);
  const Eigen::Isometry3d expected = recent_.back().odom_from_base * vision::se3_exp(gap_s * velocity(recent_));
  return apart_m(Eigen::Isometry3d::Identity(), here.odom_from_base) < apart_m(expected, here.odom_from_base);
}

bool OdometryOrigin::is_within_reach(const Place& from, const Place& to) const {
  return vision::is_within_reach(from.odom_from_base, to.odom_from_base, vision::seconds(from.stamp_ns, to.stamp_ns),
                                 max_speed_m_s_);
}

/// Mean over the places in the axes of the vehicle, m/s and rad/s; 0 if unknown, and no faster than a vehicle.
vision::Vector6d OdometryOrigin::velocity(const Places& places) const {
  const Place& from = places.front();
  const Place& to = places.back();
  if (from.stamp_ns == to.stamp_ns) return vision::Vector6d::Zero();
  const vision::Vector6d velocity =
      vision::se3_log(from.odom_from_base.inverse() * to.odom_from_base) / vision::seconds(from.stamp_ns, to.stamp_ns);
  return velocity * std::min(1.0, max_speed_m_s_ / std::max(velocity.head<3>().norm(), max_speed_m_s_));
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

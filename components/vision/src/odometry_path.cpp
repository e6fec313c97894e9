// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/odometry_path.hpp"

#include <algorithm>
#include <utility>

#include "panvo/vision/seconds.hpp"

namespace panvo::vision {
namespace {

constexpr double kSlack_m = 5.0;    // for jitter of the stamps: tens of milliseconds at 50 m/s
constexpr double kClearly = 0.25;   // fraction of a variance: half of the standard deviation
constexpr double kArm_m = 1.0;      // converts an angle to a distance: of a point beside the vehicle's origin
constexpr double kBase_s = 0.1;     // over which a velocity is measured: stamps jitter by milliseconds
constexpr double kCarries_s = 5.0;  // after that, a vehicle may as well have stopped

double apart_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (b.translation() - a.translation()).norm() + kArm_m * so3_log(a.linear().transpose() * b.linear()).norm();
}

/// Of the horizontal position and the yaw: tilt and height may be known from another sensor, such as an accelerometer.
bool is_clearly_smaller(const Matrix6d& covariance, const Matrix6d& than) {
  const auto place = [](const Matrix6d& of) { return of.topLeftCorner<2, 2>().trace(); };
  const auto yaw = [](const Matrix6d& of) { return of(kYaw, kYaw); };
  return place(covariance) <= place(than) && yaw(covariance) <= yaw(than) &&
         (place(covariance) < kClearly * place(than) || yaw(covariance) < kClearly * yaw(than));
}

}  // namespace

OnPath OdometryPath::add(std::int64_t stamp_ns, const Eigen::Isometry3d& odom_from_base, const Matrix6d& covariance,
                         bool is_reliable) {
  const Place here{stamp_ns, odom_from_base};
  if (recent_.empty() || continues(here, covariance)) {
    follows_ = !recent_.empty() && elsewhere_.empty();
    accept(here, covariance, is_reliable);
    return OnPath::kGoesOn;
  }
  if (!elsewhere_.empty() && !is_within_reach(elsewhere_.back(), here)) elsewhere_.clear();
  follows_ = !elsewhere_.empty();
  elsewhere_.push_back(here);
  if (elsewhere_.size() < kRun) return OnPath::kElsewhere;
  begin_anew(covariance);
  return OnPath::kRestarted;
}

bool OdometryPath::goes_on(double time_s, const Eigen::Isometry3d& odom_from_base, const Matrix6d& covariance) const {
  if (recent_.empty()) return true;
  return elsewhere_.empty() && is_within_reach(recent_.back().odom_from_base, odom_from_base, time_s) &&
         !begins(odom_from_base, covariance, time_s);
}

bool OdometryPath::reaches(std::int64_t stamp_ns, const Eigen::Isometry3d& odom_from_base) const {
  return recent_.empty() || is_within_reach(recent_.back(), {stamp_ns, odom_from_base});
}

void OdometryPath::set_clock_back(std::int64_t by_ns) {
  for (auto* places : {&recent_, &elsewhere_}) {
    for (auto& place : *places) place.stamp_ns -= by_ns;
  }
}

/// The longer poses are elsewhere, the more a vehicle can reach, so that those at another place are compared, too.
bool OdometryPath::continues(const Place& here, const Matrix6d& covariance) const {
  const Place& last = recent_.back();
  if (!is_within_reach(last, here) || begins(here.odom_from_base, covariance, seconds(last.stamp_ns, here.stamp_ns)))
    return false;
  if (elsewhere_.empty() || !is_within_reach(elsewhere_.back(), here)) return true;
  const auto speed = [&](const Place& from) {
    return apart_m(from.odom_from_base, here.odom_from_base) / seconds(from.stamp_ns, here.stamp_ns);
  };
  return speed(elsewhere_.back()) >= speed(last);
}

/// Whether an odometry seems to begin. The covariance of one that only integrates never shrinks. If another one's does,
/// as it closes a loop or states the error of each step, its pose is where the motion leads rather than at its origin.
bool OdometryPath::begins(const Eigen::Isometry3d& here, const Matrix6d& covariance, double time_s) const {
  if (shrinks_ || !is_clearly_smaller(covariance, reliable_covariance_)) return false;
  const Eigen::Isometry3d expected =
      recent_.back().odom_from_base * se3_exp(std::min(time_s, kCarries_s) * velocity(recent_));
  return apart_m(Eigen::Isometry3d::Identity(), here) < apart_m(expected, here);
}

/// Keeps as few places as show the velocity.
void OdometryPath::accept(const Place& here, const Matrix6d& covariance, bool is_reliable) {
  shrinks_ |= !recent_.empty() && is_clearly_smaller(covariance, reliable_covariance_) &&
              !is_within_reach({recent_.back().stamp_ns, Eigen::Isometry3d::Identity()}, here);
  elsewhere_.clear();
  recent_.push_back(here);
  const auto is_base = [&](const Place& place) { return seconds(place.stamp_ns, here.stamp_ns) >= kBase_s; };
  const auto shorter = std::find_if_not(recent_.begin(), recent_.end() - 1, is_base);
  if (shorter != recent_.begin()) recent_.erase(recent_.begin(), shorter - 1);
  if (is_reliable) reliable_covariance_ = covariance;
}

void OdometryPath::begin_anew(const Matrix6d& covariance) {
  const double gap_s = std::min(seconds(recent_.back().stamp_ns, elsewhere_.back().stamp_ns), kCarries_s);
  motion_to_restart_ = se3_exp(0.5 * gap_s * (velocity(recent_) + velocity(elsewhere_)));
  recent_ = std::exchange(elsewhere_, {});
  reliable_covariance_ = covariance;
}

bool OdometryPath::is_within_reach(const Place& from, const Place& to) const {
  return is_within_reach(from.odom_from_base, to.odom_from_base, seconds(from.stamp_ns, to.stamp_ns));
}

bool OdometryPath::is_within_reach(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double time_s) const {
  return (to.translation() - from.translation()).norm() <= kSlack_m + max_speed_m_s_ * time_s;
}

/// Mean over the places.
Vector6d OdometryPath::velocity(const Places& places) const {
  if (places.empty() || places.front().stamp_ns == places.back().stamp_ns) return Vector6d::Zero();
  const Place &from = places.front(), &to = places.back();
  const Vector6d velocity =
      se3_log(from.odom_from_base.inverse() * to.odom_from_base) / seconds(from.stamp_ns, to.stamp_ns);
  return velocity * std::min(1.0, max_speed_m_s_ / std::max(velocity.head<3>().norm(), max_speed_m_s_));
}

}  // namespace panvo::vision

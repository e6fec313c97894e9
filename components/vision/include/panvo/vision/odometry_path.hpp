// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "panvo/vision/pose.hpp"

namespace panvo::vision {

/// Where a pose of an odometry is.
enum class OnPath {
  kGoesOn,     ///< on the path of those before
  kElsewhere,  ///< not: it is wrong, or one of the first of an odometry that was restarted
  kRestarted,  ///< not either, but odometry was restarted with another origin: this is its path from now on
};

/// Tells an odometry that was restarted from one that goes on. A pose is elsewhere if no vehicle can reach it from the
/// previous one, or if odometry seems to restart there: near its origin, with a much smaller covariance. If several
/// consecutive ones agree on such a place, odometry was restarted.
class OdometryPath {
 public:
  /// `max_speed_m_s`: of any possible vehicle.
  explicit OdometryPath(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  /// The next pose, as received. `is_reliable`: measured since the one before. Precondition: stamps increase.
  OnPath add(std::int64_t stamp_ns, const Eigen::Isometry3d& odom_from_base, const Matrix6d& covariance,
             bool is_reliable);

  /// Whether the last pose of add() shows the motion since the one before: odometry was not restarted between them.
  bool follows() const noexcept { return follows_; }

  /// Whether the path would go on at a pose, `time_s` after the last one whatever its stamp says.
  bool goes_on(double time_s, const Eigen::Isometry3d& odom_from_base, const Matrix6d& covariance) const;

  /// Whether a vehicle gets from the last pose on the path to another one in time.
  bool reaches(std::int64_t stamp_ns, const Eigen::Isometry3d& odom_from_base) const;

  /// At the end of the path, in the axes of the vehicle, m/s and rad/s; 0 if unknown, and no faster than a vehicle.
  Vector6d velocity() const { return velocity(recent_); }

  /// After a restart: the motion from the last pose before it, if the vehicle was as fast as before and after it, on the
  /// mean.
  const Eigen::Isometry3d& motion_to_restart() const noexcept { return motion_to_restart_; }

  /// Shifts all stamps back.
  void set_clock_back(std::int64_t by_ns);

 private:
  struct Place {
    std::int64_t stamp_ns;
    Eigen::Isometry3d odom_from_base;
  };
  using Places = std::vector<Place>;

  bool continues(const Place& here, const Matrix6d& covariance) const;
  bool begins(const Eigen::Isometry3d& here, const Matrix6d& covariance, double time_s) const;
  void accept(const Place& here, const Matrix6d& covariance, bool is_reliable);
  void begin_anew(const Matrix6d& covariance);
  bool is_within_reach(const Place& from, const Place& to) const;
  bool is_within_reach(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double time_s) const;
  Vector6d velocity(const Places& places) const;

  static constexpr std::size_t kRun = 5;  // consecutive poses that agree on another place

  double max_speed_m_s_;
  // The last ones on the path, over a time that shows the velocity, and the ones elsewhere since then that agree.
  Places recent_, elsewhere_;
  Matrix6d reliable_covariance_ = Matrix6d::Zero();  // of the last reliable pose on the path
  bool shrinks_ = false;  // the covariance, by itself: it has where no restarted odometry can be
  bool follows_ = false;
  Eigen::Isometry3d motion_to_restart_ = Eigen::Isometry3d::Identity();
};

}  // namespace panvo::vision

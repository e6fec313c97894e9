// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "panvo/localizer/odometry_buffer.hpp"

namespace panvo::localizer {

/// Turns odometry into one continuous motion. A pose that no vehicle can reach from the previous one is rejected. If
/// several in a row agree on such a place, odometry was restarted with another origin: the motion continues from the
/// last pose, with an unmeasured gap.
class OdometryOrigin {
 public:
  /// `max_speed_m_s`: of any possible vehicle.
  explicit OdometryOrigin(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  struct Taken {
    std::optional<OdometryPose> odometry;  ///< nullopt: rejected
    bool is_new_origin = false;
    std::string reason;  ///< of the rejection
  };

  /// Precondition: stamps increase.
  Taken take(const OdometryPose& received);

  /// Shifts all stamps back.
  void set_clock_back(std::int64_t by_ns);

 private:
  struct Place {
    std::int64_t stamp_ns;
    Eigen::Isometry3d odom_from_base;
  };

  bool is_within_reach(const Place& from, const Place& to) const;
  OdometryPose continued(const OdometryPose& received) const;

  static constexpr int kRun = 5;  // consecutive messages that agree on another place

  const double max_speed_m_s_;
  std::optional<Place> last_, elsewhere_;  // as received: last accepted, and last rejected since
  int run_ = 0;
  std::optional<Eigen::Isometry3d> odom_from_received_;  // nullopt: identical
  vision::Matrix6d covariance_before_ = vision::Matrix6d::Zero();
  OdometryPose latest_;  // as returned
};

}  // namespace panvo::localizer

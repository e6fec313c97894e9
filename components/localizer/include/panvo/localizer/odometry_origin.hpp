// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/localizer/odometry_buffer.hpp"

namespace panvo::localizer {

/// Turns odometry into one continuous motion. A pose that no vehicle can reach from the previous one is rejected, and
/// so is one at which odometry seems to restart: near its origin, with a much smaller covariance. If several in a row
/// agree on such a place, odometry was restarted with another origin: the motion continues from the last pose, with an
/// unmeasured gap.
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
  using Places = std::vector<Place>;
  struct Shift {  // the pose at which odometry restarted, as received and as continued
    OdometryPose received, continued;
  };

  void accept(const OdometryPose& received);
  void begin_anew(const OdometryPose& received);
  bool goes_on(const Place& here, const vision::Matrix6d& covariance) const;
  bool begins(const Place& here, const vision::Matrix6d& covariance) const;
  bool is_within_reach(const Place& from, const Place& to) const;
  vision::Vector6d velocity(const Places& places) const;
  OdometryPose continued(const OdometryPose& received) const;

  static constexpr std::size_t kRun = 5;  // consecutive messages that agree on another place

  const double max_speed_m_s_;
  // As received: the last accepted ones, over a time that shows the velocity, and the rejected ones since that agree.
  Places recent_, elsewhere_;
  vision::Matrix6d reliable_covariance_ = vision::Matrix6d::Zero();  // of the last reliable pose, as received
  bool shrinks_ = false;        // the covariance, by itself: it has where no restarted odometry can be
  std::optional<Shift> shift_;  // nullopt: none
  OdometryPose latest_;         // as returned
};

}  // namespace panvo::localizer

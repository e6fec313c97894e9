// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "panvo/localizer/odometry_chain.hpp"

namespace panvo::localizer {

/// Odometry as one continuous motion. A pose that no vehicle reaches from the one before is refused. Where several in a row agree on such a place,
/// odometry has begun anew elsewhere (its process was restarted): the vehicle is then where it was, and what lies between was not measured.
class OdometryOrigin {
 public:
  /// `max_speed_m_s`: of any vehicle that this may be.
  explicit OdometryOrigin(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  struct Taken {
    std::optional<OdometryPose> odometry;  ///< nullopt: refused
    bool is_new_origin = false;
    std::string reason;  ///< why refused
  };

  /// Precondition: stamps increase.
  Taken take(const OdometryPose& told);

  /// All stamps so far become so much earlier.
  void set_clock_back(std::int64_t by_ns);

 private:
  struct Place {
    std::int64_t stamp_ns;
    Eigen::Isometry3d odom_from_base;
  };

  bool is_within_reach(const Place& from, const Place& to) const;
  OdometryPose continued(const OdometryPose& told) const;

  static constexpr int kRun = 5;           // messages that agree on another place
  static constexpr double kSlack_m = 5.0;  // stamps may jitter by tens of milliseconds at 50 m/s

  const double max_speed_m_s_;
  std::optional<Place> last_, elsewhere_;  // as told; of those taken, and of those refused since
  int run_ = 0;
  std::optional<Eigen::Isometry3d> odom_from_told_;  // nullopt: they are one
  vision::Matrix6d covariance_before_ = vision::Matrix6d::Zero();
  OdometryPose latest_;  // as it was given on
};

}  // namespace panvo::localizer

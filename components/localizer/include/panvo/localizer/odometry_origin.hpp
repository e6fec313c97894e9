// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "panvo/localizer/odometry_buffer.hpp"
#include "panvo/vision/odometry_path.hpp"

namespace panvo::localizer {

/// Turns odometry into one continuous motion. A pose that is not on its path (vision::OdometryPath) is rejected. If
/// odometry was restarted with another origin, the motion continues from the last pose, with an unmeasured gap.
class OdometryOrigin {
 public:
  /// `max_speed_m_s`: of any possible vehicle.
  explicit OdometryOrigin(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s), path_(max_speed_m_s) {}

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
  struct Shift {  // the pose at which odometry restarted, as received and as continued
    OdometryPose received, continued;
  };

  void begin_anew(const OdometryPose& received);
  OdometryPose continued(const OdometryPose& received) const;

  const double max_speed_m_s_;
  vision::OdometryPath path_;   // as received
  std::optional<Shift> shift_;  // nullopt: none
  OdometryPose latest_;         // as returned
};

}  // namespace panvo::localizer

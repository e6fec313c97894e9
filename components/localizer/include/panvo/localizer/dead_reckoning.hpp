// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

/// What may happen to a vehicle while nothing measures its motion.
struct MotionPrior {
  double acceleration_m_s2 = 1.5;
  double speed_m_s = 10.0;
  double turn_acceleration_rad_s2 = 0.5;
  double turn_rate_rad_s = 0.5;

  template <class Field>
  static void describe(Field&& field) {
    using P = MotionPrior;
    field(&P::acceleration_m_s2, "acceleration_m_s2", "m/s^2",
          "standard deviation of the acceleration of a vehicle whose motion is not measured", 0.0, 100.0);
    field(&P::speed_m_s, "speed_m_s", "m/s", "standard deviation of its speed, which bounds what that comes to", 0.0,
          1000.0);
    field(&P::turn_acceleration_rad_s2, "turn_acceleration_rad_s2", "rad/s^2", "the same of its turns", 0.0, 100.0);
    field(&P::turn_rate_rad_s, "turn_rate_rad_s", "rad/s", "the same of its turns", 0.0, 100.0);
  }
};

/// How far a vehicle of which it is known how it moved strays within a time from going on like that: standard deviations.
double way_sigma_m(const MotionPrior& prior, double seconds);
double turn_sigma_rad(const MotionPrior& prior, double seconds);

/// How uncertain a step of the odometry is at least: by the time for which nothing has measured the motion, whether it passed as many frames
/// that could not be relied on or as one gap.
class DeadReckoning {
 public:
  /// `gap_s`: from which interval on a step counts as a gap, unless odometry is as slow as a rule.
  DeadReckoning(const MotionPrior& prior, double gap_s) : prior_(prior), gap_s_(gap_s) {}

  /// Least covariance of a step of `interval_s`, in the vehicle's axes; zero for a step that was measured.
  vision::Matrix6d step(double interval_s, bool is_reliable);

  /// The same of a silence that goes on since the last step.
  vision::Matrix6d silence(double seconds) const;

 private:
  vision::Vector6d variance_after(double seconds) const;

  const MotionPrior prior_;
  const double gap_s_;
  double usual_s_ = 0.0;  // interval
  double blind_s_ = 0.0;  // since motion was measured last
};

/// `covariance`, but along no direction less than `least`: for two covariances of the same, of which one may say too little.
vision::Matrix6d at_least(const vision::Matrix6d& covariance, const vision::Matrix6d& least);

}  // namespace panvo::localizer

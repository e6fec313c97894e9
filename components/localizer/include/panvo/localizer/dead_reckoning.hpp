// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/vision/pose.hpp"
#include "panvo/vision/usual_interval.hpp"

namespace panvo::localizer {

inline constexpr double kClimb = 0.1;  ///< standard deviation of the height, fraction of the path

/// Possible motion of a vehicle while it is not measured.
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
    field(&P::speed_m_s, "speed_m_s", "m/s", "standard deviation of its speed, which limits the effect", 0.0, 1000.0);
    field(&P::turn_acceleration_rad_s2, "turn_acceleration_rad_s2", "rad/s^2", "the same for its turns", 0.0, 100.0);
    field(&P::turn_rate_rad_s, "turn_rate_rad_s", "rad/s", "the same for its turns", 0.0, 100.0);
  }
};

/// Standard deviations of a vehicle's deviation from constant motion after a time.
double way_sigma_m(const MotionPrior& prior, double seconds);
double turn_sigma_rad(const MotionPrior& prior, double seconds);

/// Lower bound of the uncertainty of odometry steps, by the time without measured motion, whether it consisted of
/// unreliable frames or of one gap.
class DeadReckoning {
 public:
  /// `gap_s`: interval from which a step counts as a gap, unless odometry is always that slow.
  DeadReckoning(const MotionPrior& prior, double gap_s) : prior_(prior), gap_s_(gap_s) {}

  /// Minimum covariance of a step of `interval_s`, in the vehicle's axes; zero for a measured step.
  vision::Matrix6d step(double interval_s, bool is_reliable);

  /// The same for a silence since the last step.
  vision::Matrix6d silence(double seconds) const;

 private:
  vision::Vector6d variance_after(double seconds) const;

  const MotionPrior prior_;
  const double gap_s_;
  vision::UsualInterval interval_;
  double blind_s_ = 0.0;  // time since the motion was last measured
};

/// `covariance`, raised to at least `least` in every direction; for combining two estimates of one covariance.
vision::Matrix6d at_least(const vision::Matrix6d& covariance, const vision::Matrix6d& least);

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/odometry_fusion/motion_filter.hpp"

namespace panvo::odometry_fusion {

/// Whether a sensor agrees with the cameras over the last second and at this moment. Small differences that last, of a
/// slipping wheel or a changed bias, add up, whereas noise averages out.
class Consistency {
 public:
  /// `innovation`: of the sensor's factor, given the cameras' motion. False if they contradict each other by more than
  /// `gate_sigmas`.
  bool add(const Innovation& innovation, double dt_s, double gate_sigmas);

  /// Whether the sensor contradicted the cameras in most of the last seconds.
  bool is_faulty() const noexcept { return contradicted_ > 0.5; }

 private:
  using Vector = Factor::Vector;

  Vector residual_, noise_variance_, systematic_sigma_;  // sums that decay
  double contradicted_ = 0.0;                            // recent share of the time
};

/// Whether the innovation is within `gate_sigmas` at this moment.
bool is_within(const Innovation& innovation, double gate_sigmas);

}  // namespace panvo::odometry_fusion

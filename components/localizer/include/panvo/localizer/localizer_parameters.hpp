// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/localizer/dead_reckoning.hpp"

namespace panvo::localizer {

struct Parameters {
  double gate_chi_square = 22.5;
  double second_look_gate_ratio = 10.0;
  double second_look_m = 0.7;
  double second_look_deg = 3.0;
  double same_pass_m = 40.0;
  double history_s = 120.0;
  double contradiction_sigmas = 4.0;
  double lean_window_s = 8.0;
  double lean_sigmas = 3.0;
  double compass_turn_error_ratio = 0.007;
  double compass_correlation_ratio = 4.0;
  double turn_scale_sigma = 0.002;
  double mounting_sigma_deg = 60.0;
  double steady_turn_share = 0.3;
  double doubtful_outlier_share = 0.02;
  double scale_sigma = 0.002;
  double clock_sigma_s = 0.05;
  double patience_s = 1.0;
  double lost_sigma_m = 50.0;
  double start_sigma_m = 0.01;
  double start_sigma_deg = 0.1;
  double gap_s = 0.5;
  double max_speed_m_s = 70.0;
  MotionPrior motion;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::gate_chi_square, "gate_chi_square", "1",
          "squared Mahalanobis distance up to which a correction is believed at once: 99.9 % of six degrees of freedom",
          1.0, 1e6);
    field(&P::second_look_gate_ratio, "second_look_gate_ratio", "1",
          "times the gate, and up to there when the next panorama asks for the same: odometry whose calibration is off "
          "drifts up to three times as fast as it says",
          1.0, 1e6);
    field(&P::second_look_m, "second_look_m", "m", "two sightings ask for the same within this", 0.01, 100.0);
    field(&P::second_look_deg, "second_look_deg", "deg", "and within this angle", 0.01, 180.0);
    field(&P::same_pass_m, "same_pass_m", "m",
          "panoramas of one landmark within this way are one pass: they err alike, and only the best of them counts",
          1.0, 1000.0);
    field(&P::history_s, "history_s", "s", "how late a landmark or a correction may come", 1.0, 3600.0);
    field(&P::contradiction_sigmas, "contradiction_sigmas", "1",
          "odometry whose turn is farther than this from the compass's is taken for wrong", 1.0, 100.0);
    field(
        &P::compass_turn_error_ratio, "compass_turn_error_ratio", "1",
        "share of a turn that the compass may miss every time: of drops on the lens and parts of the vehicle, which do "
        "not turn against the camera",
        0.0, 0.5);
    field(&P::compass_correlation_ratio, "compass_correlation_ratio", "1",
          "variance of the sum of many turns of the compass over the sum of their variances: what stands close beside "
          "the way misleads it alike for as long as it is passed; 1: each errs by itself",
          1.0, 100.0);
    field(
        &P::turn_scale_sigma, "turn_scale_sigma", "1",
        "standard deviation of the share by which odometry turns too much or too little, before the compass tells it: "
        "of focal lengths some months after they were calibrated; 0: they are right",
        0.0, 0.1);
    field(
        &P::mounting_sigma_deg, "mounting_sigma_deg", "deg",
        "standard deviation of the angle between the panoramic and the stereo camera about the vertical, against what "
        "/tf_static says, before the directions that they see the vehicle drive in tell it; smaller where it is "
        "measured, so that a mover at the start is not taken for it",
        0.0, 180.0);
    field(&P::steady_turn_share, "steady_turn_share", "1",
          "how much of the variance that odometry says of its turns is believed where all of its points agree: what it "
          "says allows for the lean of long ways, and beside the compass it is the next seconds that count",
          0.001, 1.0);
    field(&P::doubtful_outlier_share, "doubtful_outlier_share", "1",
          "share of the points that move otherwise, from which on all of that variance is believed: where so many are "
          "seen to move by themselves, others do so unseen",
          0.001, 1.0);
    field(
        &P::scale_sigma, "scale_sigma", "1",
        "standard deviation of the odometry's scale, the same all the way and so for all landmarks: of an aged stereo "
        "calibration, allowed for by the odometry; it shows in the covariance that is told",
        0.0, 0.5);
    field(&P::clock_sigma_s, "clock_sigma_s", "s",
          "standard deviation of the offset between the cameras' clocks before it is known; 0: they are one", 0.0, 1.0);
    field(&P::patience_s, "patience_s", "s",
          "how long neither odometry nor compass need be reliable before the vehicle counts as lost", 0.0, 60.0);
    field(&P::lost_sigma_m, "lost_sigma_m", "m",
          "standard deviation of the position from which on it counts as lost, too", 1.0, 1e6);
    field(&P::start_sigma_m, "start_sigma_m", "m", "of the pose that the map begins with", 1e-6, 10.0);
    field(&P::start_sigma_deg, "start_sigma_deg", "deg", "of the pose that the map begins with", 1e-6, 90.0);
    field(
        &P::gap_s, "gap_s", "s",
        "from which time between two odometry messages on the motion between them counts as not measured, unless they "
        "are as slow as a rule",
        0.01, 60.0);
    field(&P::max_speed_m_s, "max_speed_m_s", "m/s",
          "odometry that moves faster is refused; several messages in a row that agree are odometry that began anew",
          1.0, 1000.0);
    field.group(&P::motion, "motion");
  }
};

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/localizer/dead_reckoning.hpp"

namespace panvo::localizer {

/// Positions by satellites.
struct GnssParameters {
  double spacing_m = 10.0;
  double correlation_s = 60.0;
  double delay_sigma_s = 0.1;
  double trial_m = 30.0;
  double gate_chi_square = 16.3;
  double doubt_m = 300.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = GnssParameters;
    field(&P::spacing_m, "spacing_m", "m", "path between two fixes that are used", 0.5, 1000.0);
    field(&P::correlation_s, "correlation_s", "s",
          "time for which errors of fixes persist, by reflections and the atmosphere: fixes within it count as one",
          0.1, 3600.0);
    field(&P::delay_sigma_s, "delay_sigma_s", "s",
          "prior standard deviation of the constant delay of the fixes' stamps, which is estimated; 0: none", 0.0,
          10.0);
    field(&P::trial_m, "trial_m", "m",
          "distance over which the fixes must have the shape of the odometry's path before they are used", 5.0,
          10000.0);
    field(&P::gate_chi_square, "gate_chi_square", "1",
          "squared Mahalanobis distance up to which a fix is used: 99.9 % of three degrees of freedom", 1.0, 1e6);
    field(&P::doubt_m, "doubt_m", "m",
          "path over which all fixes were outside the gate after which they are tried anew: longer than a wall or a "
          "row of trees reflects or hides satellites",
          10.0, 1e5);
  }
};

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
  double compass_correlation_ratio = 2.0;
  double turn_scale_sigma = 0.002;
  double turn_lean_sigma_deg_m = 0.008;
  double mounting_sigma_deg = 60.0;
  double stereo_mounting_sigma_deg = 0.3;
  double scale_sigma = 0.002;
  double clock_sigma_s = 0.05;
  double patience_s = 1.0;
  double lost_sigma_m = 50.0;
  double start_sigma_m = 0.01;
  double start_sigma_deg = 0.1;
  double gap_s = 0.5;
  double max_speed_m_s = 70.0;
  MotionPrior motion;
  GnssParameters gnss;

  template <class Field>
  static void describe(Field&& field) {
    using P = Parameters;
    field(&P::gate_chi_square, "gate_chi_square", "1",
          "squared Mahalanobis distance up to which a correction is applied at once: 99.9 % of six degrees of freedom",
          1.0, 1e6);
    field(&P::second_look_gate_ratio, "second_look_gate_ratio", "1",
          "multiple of the gate up to which a correction is applied if the next panorama confirms it: badly calibrated "
          "odometry drifts up to three times as fast as stated",
          1.0, 1e6);
    field(&P::second_look_m, "second_look_m", "m", "largest distance between two sightings that agree", 0.01, 100.0);
    field(&P::second_look_deg, "second_look_deg", "deg", "largest angle between two sightings that agree", 0.01, 180.0);
    field(&P::same_pass_m, "same_pass_m", "m",
          "panoramas of one landmark within this path are one pass: their errors are alike, only the best one counts",
          1.0, 1000.0);
    field(&P::history_s, "history_s", "s", "largest delay of landmarks and corrections", 1.0, 3600.0);
    field(&P::contradiction_sigmas, "contradiction_sigmas", "1",
          "odometry whose turn differs more from the compass is considered wrong", 1.0, 100.0);
    field(&P::compass_turn_error_ratio, "compass_turn_error_ratio", "1",
          "fraction of a turn that the compass may always miss: drops on the lens and parts of the vehicle do "
          "not rotate relative to the camera",
          0.0, 0.5);
    field(&P::compass_correlation_ratio, "compass_correlation_ratio", "1",
          "variance of the sum of many compass turns over the sum of their variances: objects close beside "
          "the path cause the same error while they are passed; 1: independent errors",
          1.0, 100.0);
    field(&P::turn_scale_sigma, "turn_scale_sigma", "1",
          "prior standard deviation of the relative scale error of odometry's turns, which the compass estimates: "
          "focal lengths change within months of their calibration; 0: exact",
          0.0, 0.1);
    field(&P::turn_lean_sigma_deg_m, "turn_lean_sigma_deg_m", "deg/m",
          "prior standard deviation of what odometry turns too far per metre, which the compass estimates, unless "
          "odometry/quality states it: an aged rectification of a pair with 400 px and 0.12 m; 0: nothing",
          0.0, 1.0);
    field(&P::mounting_sigma_deg, "mounting_sigma_deg", "deg",
          "prior standard deviation of the yaw between the panoramic and the stereo camera relative to "
          "/tf_static, before it is estimated from the driving direction; reduce it if the yaw is "
          "measured, so that moving objects at the start are not mistaken for it",
          0.0, 180.0);
    field(&P::stereo_mounting_sigma_deg, "stereo_mounting_sigma_deg", "deg",
          "standard deviation of the yaw of the stereo camera on the vehicle relative to /tf_static, which turns the "
          "whole path; the panoramas show larger errors",
          0.001, 180.0);
    field(&P::scale_sigma, "scale_sigma", "1",
          "standard deviation of the odometry's scale, constant and thus common to all landmarks: remainder of an aged "
          "stereo calibration that odometry compensates; included in the published covariance",
          0.0, 0.5);
    field(&P::clock_sigma_s, "clock_sigma_s", "s",
          "prior standard deviation of the offset between the cameras' clocks; 0: common clock", 0.0, 1.0);
    field(&P::patience_s, "patience_s", "s",
          "time without reliable odometry and compass after which the vehicle is lost", 0.0, 60.0);
    field(&P::lost_sigma_m, "lost_sigma_m", "m", "standard deviation of the position above which the vehicle is lost",
          1.0, 1e6);
    field(&P::start_sigma_m, "start_sigma_m", "m", "standard deviation of the initial position of a map", 1e-6, 10.0);
    field(&P::start_sigma_deg, "start_sigma_deg", "deg", "standard deviation of the initial orientation of a map", 1e-6,
          90.0);
    field(&P::gap_s, "gap_s", "s",
          "interval between odometry messages from which the motion counts as not measured, unless they "
          "are always that slow",
          0.01, 60.0);
    field(&P::max_speed_m_s, "max_speed_m_s", "m/s",
          "faster odometry is rejected; several consecutive messages that agree are restarted odometry", 1.0, 1000.0);
    field.group(&P::motion, "motion");
    field.group(&P::gnss, "gnss");
  }
};

}  // namespace panvo::localizer

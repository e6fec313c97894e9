// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace panvo::odometry_fusion {

/// Errors of a gyroscope. The defaults are those of a MEMS gyroscope of a robot's IMU.
struct GyroParameters {
  double noise_rad_s_sqrt_hz = 5e-4;
  double bias_sigma_rad_s = 0.05;
  double bias_walk_rad_s2_sqrt_hz = 2e-5;
  double scale_sigma = 0.01;
  double mounting_sigma_rad = 0.02;
  double clock_sigma_s = 0.01;

  template <class Field>
  static void describe(Field&& field) {
    using P = GyroParameters;
    field(&P::noise_rad_s_sqrt_hz, "noise_rad_s_sqrt_hz", "rad/s/sqrt(Hz)", "density of the white noise", 1e-6, 1.0);
    field(&P::bias_sigma_rad_s, "bias_sigma_rad_s", "rad/s", "standard deviation of the bias when switched on", 0.0,
          1.0);
    field(&P::bias_walk_rad_s2_sqrt_hz, "bias_walk_rad_s2_sqrt_hz", "rad/s^2/sqrt(Hz)",
          "density of the bias's random walk", 0.0, 1.0);
    field(&P::scale_sigma, "scale_sigma", "1", "standard deviation of the scale error", 0.0, 0.2);
    field(&P::mounting_sigma_rad, "mounting_sigma_rad", "rad", "standard deviation of the mounting in /tf_static", 0.0,
          0.2);
    field(&P::clock_sigma_s, "clock_sigma_s", "s", "standard deviation of the offset to the cameras' clock", 0.0, 0.1);
  }
};

/// Errors of wheel odometry. The defaults are those of a car or a robot on rubber tyres.
struct WheelParameters {
  double noise_per_sqrt_m = 0.01;
  double tick_m = 0.002;
  double yaw_noise_rad_per_sqrt_m = 0.01;
  double yaw_error_ratio = 0.05;
  double side_slip_per_sqrt_m = 0.03;
  double scale_sigma = 0.05;
  double yaw_scale_sigma = 0.1;
  double axle_sigma_m = 0.3;
  double direction_sigma_rad = 0.02;

  template <class Field>
  static void describe(Field&& field) {
    using P = WheelParameters;
    field(&P::noise_per_sqrt_m, "noise_per_sqrt_m", "m/sqrt(m)", "distance error by unevenness and slip", 1e-5, 1.0);
    field(&P::tick_m, "tick_m", "m", "resolution of the encoders", 0.0, 1.0);
    field(&P::yaw_noise_rad_per_sqrt_m, "yaw_noise_rad_per_sqrt_m", "rad/sqrt(m)", "rotation error", 1e-5, 1.0);
    field(&P::yaw_error_ratio, "yaw_error_ratio", "1", "rotation error relative to the rotation: tyres scrub in turns",
          0.0, 1.0);
    field(&P::side_slip_per_sqrt_m, "side_slip_per_sqrt_m", "m/sqrt(m)",
          "motion to the side and upwards that wheels do not measure", 1e-5, 1.0);
    field(&P::scale_sigma, "scale_sigma", "1", "standard deviation of the scale error: tyre radius", 0.0, 0.2);
    field(&P::yaw_scale_sigma, "yaw_scale_sigma", "1", "standard deviation of the scale of rotations: track width", 0.0,
          0.5);
    field(&P::axle_sigma_m, "axle_sigma_m", "m",
          "standard deviation of the distance from the axle that does not steer forward to base_link", 0.0, 10.0);
    field(&P::direction_sigma_rad, "direction_sigma_rad", "rad",
          "standard deviation of the rolling direction from base_link's x axis: extrinsics of the cameras", 0.0, 0.5);
  }
};

struct FusionParameters {
  GyroParameters gyro;
  WheelParameters wheels;
  double stereo_scale_sigma = 0.002;
  double stereo_turn_scale_sigma = 0.001;
  double acceleration_m_s2_sqrt_hz = 1.5;
  double turn_acceleration_rad_s2_sqrt_hz = 0.5;
  double max_speed_m_s = 60.0;
  double gate_sigmas = 5.0;
  double patience_s = 0.1;

  template <class Field>
  static void describe(Field&& field) {
    using P = FusionParameters;
    field.group(&P::gyro, "gyro");
    field.group(&P::wheels, "wheels");
    field(&P::stereo_scale_sigma, "stereo_scale_sigma", "1",
          "standard deviation of the stereo calibration's scale: baseline, focal length", 0.0, 0.1);
    field(&P::stereo_turn_scale_sigma, "stereo_turn_scale_sigma", "1",
          "standard deviation of the scale of turns by stereo: focal length", 0.0, 0.1);
    field(&P::acceleration_m_s2_sqrt_hz, "acceleration_m_s2_sqrt_hz", "m/s^2/sqrt(Hz)",
          "change of an unmeasured velocity: 1.5 m/s after a second", 0.0, 100.0);
    field(&P::turn_acceleration_rad_s2_sqrt_hz, "turn_acceleration_rad_s2_sqrt_hz", "rad/s^2/sqrt(Hz)",
          "the same of an unmeasured rotation rate", 0.0, 100.0);
    field(&P::max_speed_m_s, "max_speed_m_s", "m/s", "faster stereo odometry is not used: it restarted elsewhere", 0.1,
          1000.0);
    field(&P::gate_sigmas, "gate_sigmas", "1",
          "a measurement that contradicts the others by more is not used: slip, moving objects", 2.0, 100.0);
    field(&P::patience_s, "patience_s", "s", "longest wait for a sensor's samples: largest delay of wheels and IMU",
          0.0, 1.0);
  }
};

}  // namespace panvo::odometry_fusion

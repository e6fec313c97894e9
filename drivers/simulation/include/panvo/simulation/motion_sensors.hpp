// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "panvo/simulated_world/random.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::simulation {

/// Errors of a MEMS gyroscope. Standard deviations: bias and scale are drawn once.
struct GyroErrors {
  double rate_hz = 200.0;
  double noise_rad_s_sqrt_hz = 2e-4;
  double bias_rad_s = 0.005;
  double bias_walk_rad_s2_sqrt_hz = 2e-5;
  double scale_ratio = 0.002;
  double saturation_rad_s = 8.7;

  template <class Field>
  static void describe(Field&& field) {
    using P = GyroErrors;
    field(&P::rate_hz, "rate_hz", "Hz", "samples per second", 1.0, 1000.0);
    field(&P::noise_rad_s_sqrt_hz, "noise_rad_s_sqrt_hz", "rad/s/sqrt(Hz)", "density of the white noise", 0.0, 1.0);
    field(&P::bias_rad_s, "bias_rad_s", "rad/s", "standard deviation of the bias at the start", 0.0, 1.0);
    field(&P::bias_walk_rad_s2_sqrt_hz, "bias_walk_rad_s2_sqrt_hz", "rad/s^2/sqrt(Hz)",
          "density of the bias's random walk", 0.0, 1.0);
    field(&P::scale_ratio, "scale_ratio", "1", "standard deviation of the scale error", 0.0, 0.5);
    field(&P::saturation_rad_s, "saturation_rad_s", "rad/s", "largest rate, here 500 degrees/s", 0.01, 100.0);
  }
};

/// Errors of wheel encoders with the track width of a small car.
struct WheelErrors {
  double rate_hz = 50.0;
  double noise_per_sqrt_m = 0.008;
  double yaw_noise_rad_per_sqrt_m = 0.008;
  double tick_m = 0.002;
  double scale_ratio = 0.01;
  double yaw_scale_ratio = 0.05;
  double slips_per_km = 5.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = WheelErrors;
    field(&P::rate_hz, "rate_hz", "Hz", "samples per second", 1.0, 1000.0);
    field(&P::noise_per_sqrt_m, "noise_per_sqrt_m", "m/sqrt(m)", "distance error by unevenness", 0.0, 1.0);
    field(&P::yaw_noise_rad_per_sqrt_m, "yaw_noise_rad_per_sqrt_m", "rad/sqrt(m)", "rotation error", 0.0, 1.0);
    field(&P::tick_m, "tick_m", "m", "distance per tick of the encoders", 1e-6, 1.0);
    field(&P::scale_ratio, "scale_ratio", "1", "standard deviation of the scale error: tyre radius", 0.0, 0.5);
    field(&P::yaw_scale_ratio, "yaw_scale_ratio", "1", "standard deviation of the scale of rotations: track width", 0.0,
          0.5);
    field(&P::slips_per_km, "slips_per_km", "1/km", "wheels spin for a second, up to twice as fast as they roll", 0.0,
          1000.0);
  }
};

/// Simulates gyroscope and wheels of a vehicle on any journey with ground truth.
class MotionSensors {
 public:
  struct Gyro {
    std::int64_t stamp_ns = 0;
    Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
  };
  struct Wheels {
    std::int64_t stamp_ns = 0;
    double forward_m_s = 0.0, yaw_rate_rad_s = 0.0;
  };
  struct Samples {
    std::vector<Gyro> gyro;
    std::vector<Wheels> wheels;
  };

  MotionSensors(const GyroErrors& gyro, const WheelErrors& wheels, std::uint64_t seed);

  /// The samples since the previous pose, at constant twist between the two. Stamps must increase.
  Samples step(std::int64_t stamp_ns, const Eigen::Isometry3d& true_world_from_base);

 private:
  struct Truth {
    std::int64_t stamp_ns;
    Eigen::Isometry3d world_from_base;
  };

  Gyro gyro(std::int64_t stamp_ns, const vision::Vector6d& twist);
  Wheels wheels(std::int64_t stamp_ns, const vision::Vector6d& twist);

  const GyroErrors gyro_;
  const WheelErrors wheels_;
  simulated_world::Random gyro_random_, wheel_random_;
  Eigen::Vector3d bias_rad_s_;
  double gyro_scale_, wheel_scale_, yaw_scale_;
  double rest_m_ = 0.0;  // rolled, less than a tick
  double slip_s_ = 0.0;  // time left of a slip
  double slip_factor_ = 1.0;
  std::optional<Truth> last_;
};

}  // namespace panvo::simulation

// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/motion_sensors.hpp"

#include <cmath>

namespace panvo::simulation {
namespace {

constexpr double kSlip_s = 1.0;

Eigen::Vector3d noise(simulated_world::Random& random) {
  const double x = random.gaussian(), y = random.gaussian(), z = random.gaussian();
  return {x, y, z};
}

/// Stamps in (from, to] of a sensor that samples at multiples of its period.
std::vector<std::int64_t> stamps_between(std::int64_t from_ns, std::int64_t to_ns, double rate_hz) {
  const std::int64_t period_ns = std::llround(1e9 / rate_hz);
  std::vector<std::int64_t> stamps;
  for (std::int64_t at = (from_ns / period_ns + 1) * period_ns; at <= to_ns; at += period_ns) stamps.push_back(at);
  return stamps;
}

}  // namespace

MotionSensors::MotionSensors(const GyroErrors& gyro, const WheelErrors& wheels, std::uint64_t seed)
    : gyro_(gyro),
      wheels_(wheels),
      gyro_random_(seed, "gyroscope"),
      wheel_random_(seed, "wheels"),
      bias_rad_s_(gyro.bias_rad_s * noise(gyro_random_)),
      gyro_scale_(1.0 + gyro.scale_ratio * gyro_random_.gaussian()),
      wheel_scale_(1.0 + wheels.scale_ratio * wheel_random_.gaussian()),
      yaw_scale_(1.0 + wheels.yaw_scale_ratio * wheel_random_.gaussian()) {}

MotionSensors::Samples MotionSensors::step(std::int64_t stamp_ns, const Eigen::Isometry3d& true_world_from_base) {
  Samples samples;
  if (last_) {
    const double interval_s = static_cast<double>(stamp_ns - last_->stamp_ns) * 1e-9;
    const vision::Vector6d twist =
        vision::se3_log(last_->world_from_base.inverse() * true_world_from_base) / interval_s;
    for (const auto at_ns : stamps_between(last_->stamp_ns, stamp_ns, gyro_.rate_hz)) {
      samples.gyro.push_back(gyro(at_ns, twist));
    }
    for (const auto at_ns : stamps_between(last_->stamp_ns, stamp_ns, wheels_.rate_hz)) {
      samples.wheels.push_back(wheels(at_ns, twist));
    }
  }
  last_ = Truth{stamp_ns, true_world_from_base};
  return samples;
}

MotionSensors::Gyro MotionSensors::gyro(std::int64_t stamp_ns, const vision::Vector6d& twist) {
  bias_rad_s_ += gyro_.bias_walk_rad_s2_sqrt_hz / std::sqrt(gyro_.rate_hz) * noise(gyro_random_);
  const Eigen::Vector3d rate = gyro_scale_ * twist.tail<3>() + bias_rad_s_ +
                               gyro_.noise_rad_s_sqrt_hz * std::sqrt(gyro_.rate_hz) * noise(gyro_random_);
  return {stamp_ns, rate.cwiseMin(gyro_.saturation_rad_s).cwiseMax(-gyro_.saturation_rad_s)};
}

MotionSensors::Wheels MotionSensors::wheels(std::int64_t stamp_ns, const vision::Vector6d& twist) {
  const double interval_s = 1.0 / wheels_.rate_hz;
  const double way_m = twist[0] * interval_s;
  if (wheel_random_.chance(std::abs(way_m) * wheels_.slips_per_km * 1e-3)) {
    slip_s_ = kSlip_s;
    slip_factor_ = wheel_random_.uniform(1.1, 2.0);
  }
  slip_s_ -= interval_s;
  const double root_m = std::sqrt(std::abs(way_m));
  const double rolled_m = wheel_scale_ * way_m * (slip_s_ > 0.0 ? slip_factor_ : 1.0) +
                          wheels_.noise_per_sqrt_m * root_m * wheel_random_.gaussian() + rest_m_;
  const double counted_m = wheels_.tick_m * std::floor(rolled_m / wheels_.tick_m);
  rest_m_ = rolled_m - counted_m;
  const double yaw_rad =
      yaw_scale_ * twist[5] * interval_s + wheels_.yaw_noise_rad_per_sqrt_m * root_m * wheel_random_.gaussian();
  return {stamp_ns, counted_m / interval_s, yaw_rad / interval_s};
}

}  // namespace panvo::simulation

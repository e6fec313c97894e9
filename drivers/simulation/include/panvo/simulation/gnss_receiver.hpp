// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "panvo/simulated_world/random.hpp"

namespace panvo::simulation {

/// Errors of a receiver without corrections among buildings.
struct GnssErrors {
  double rate_hz = 1.0;
  double noise_m = 0.4;
  double slow_error_m = 1.2;
  double slow_error_s = 100.0;
  double reflections_per_km = 1.5;
  double reflection_m = 12.0;
  double outages_per_km = 1.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = GnssErrors;
    field(&P::rate_hz, "rate_hz", "Hz", "positions per second", 0.1, 50.0);
    field(&P::noise_m, "noise_m", "m", "standard deviation of each axis, independent; twice that of the height", 0.0,
          100.0);
    field(&P::slow_error_m, "slow_error_m", "m",
          "standard deviation of each axis, of errors that persist; twice that of the height", 0.0, 100.0);
    field(&P::slow_error_s, "slow_error_s", "s", "time within which these change", 1.0, 1e5);
    field(&P::reflections_per_km, "reflections_per_km", "1/km",
          "stretches of 20 to 60 m along which reflections displace the position, which the covariance does not show",
          0.0, 100.0);
    field(&P::reflection_m, "reflection_m", "m", "standard deviation of that displacement", 0.0, 1000.0);
    field(&P::outages_per_km, "outages_per_km", "1/km", "stretches of 20 to 60 m without position", 0.0, 100.0);
  }
};

/// Simulates a satellite receiver on any journey with ground truth.
class GnssReceiver {
 public:
  struct Fix {
    std::int64_t stamp_ns = 0;
    bool has_position = true;
    Eigen::Vector3d world_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();  ///< as stated by the receiver
  };

  GnssReceiver(const GnssErrors& errors, std::uint64_t seed);

  /// The position at a pose of the journey, if one is due. Stamps must increase.
  std::optional<Fix> step(std::int64_t stamp_ns, const Eigen::Vector3d& true_world_m);

 private:
  void begin_stretches(double way_m);
  Eigen::Vector3d noise();

  const GnssErrors errors_;
  simulated_world::Random random_;
  Eigen::Vector3d slow_m_, reflection_m_ = Eigen::Vector3d::Zero();
  double reflection_left_m_ = 0.0, outage_left_m_ = 0.0;  // of the present stretch
  std::optional<std::int64_t> last_ns_;
  Eigen::Vector3d last_m_ = Eigen::Vector3d::Zero();
};

}  // namespace panvo::simulation

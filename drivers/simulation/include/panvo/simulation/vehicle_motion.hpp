// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "panvo/simulation/route.hpp"
#include "panvo/simulation/terrain.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::simulation {

struct MotionParameters {
  double cruise_speed_m_per_s = 5.0;        ///< on straight roads
  double turn_acceleration_m_per_s2 = 1.2;  ///< lateral, which limits the speed in turns (never below min_speed)
  double min_speed_m_per_s = 3.0;
  double acceleration_m_per_s2 = 1.0;  ///< along the path, at most
  double standstill_s = 1.0;           ///< before it starts
  double vibration = 1.0;              ///< scale of all below; 0: rides like on rails
  double pitch_rms_rad = 0.004;        ///< springs and dampers: 1-3 Hz
  double roll_rms_rad = 0.003;
  double height_rms_m = 0.006;
};

/// The vehicle's motion along a path: smooth (twice differentiable in time), exact at every instant.
class VehicleMotion {
 public:
  VehicleMotion(const DrivenPath& path, const Terrain& terrain, const MotionParameters& parameters, std::uint64_t seed);

  double duration_s() const;
  /// base_link (x forward, y left, z up, on the ground below the vehicle's middle) in the world, t in [0, duration].
  Eigen::Isometry3d world_from_base(double t_s) const;
  /// Velocity (m/s) and angular rate (rad/s) of base_link, in base_link.
  vision::Vector6d twist(double t_s) const;
  double travelled_m(double t_s) const;  ///< along the path
  double speed_m_per_s(double t_s) const;
  const DrivenPath& path() const;

 private:
  // knots of the arc length over time, and the vibration's waves
  struct Wave {
    double per_s, phase_rad, amplitude;
  };
  DrivenPath path_;
  Terrain terrain_;
  double duration_s_ = 0.0;
  double standstill_s_ = 0.0;
  double step_s_ = 0.0;
  std::vector<double> arc_m_;  // at multiples of step_s_
  std::vector<Wave> pitch_, roll_, height_;
};

}  // namespace panvo::simulation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "panvo/simulated_world/terrain.hpp"
#include "panvo/simulation/route.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::simulation {

struct MotionParameters {
  double cruise_speed_m_per_s = 5.0;        ///< on straight roads
  double turn_acceleration_m_per_s2 = 1.2;  ///< lateral, which limits the speed in turns (never below min_speed)
  double min_speed_m_per_s = 3.0;
  double acceleration_m_per_s2 = 1.0;  ///< along the path, at most
  double standstill_s = 1.0;           ///< before the start
  double vibration = 1.0;              ///< scale of the values below; 0: none
  double pitch_rms_rad = 0.004;        ///< suspension: 1-3 Hz
  double roll_rms_rad = 0.003;
  double height_rms_m = 0.006;
};

/// The vehicle's motion along a path: smooth (twice differentiable in time), exact at every instant.
class VehicleMotion {
 public:
  /// Throws std::invalid_argument for an invalid parameter or a path whose points are not evenly spaced.
  VehicleMotion(const DrivenPath& path, const simulated_world::Terrain& terrain, const MotionParameters& parameters,
                std::uint64_t seed);

  double duration_s() const;
  /// base_link (x forward, y left, z up, on the ground below the vehicle's centre) in the world, t in [0, duration].
  Eigen::Isometry3d world_from_base(double t_s) const;
  /// Velocity (m/s) and angular rate (rad/s) of base_link, in base_link.
  vision::Vector6d twist(double t_s) const;
  double travelled_m(double t_s) const;  ///< along the path
  double speed_m_per_s(double t_s) const;
  double cruise_speed_m_per_s() const;
  const DrivenPath& path() const;

 private:
  struct Wave {
    double per_s, phase_rad, amplitude;
  };
  struct Place {
    Eigen::Vector2d position;
    double heading_rad;
  };
  Place place(double arc_m) const;
  double sum(const std::vector<Wave>& waves, double t_s) const;
  void plan_speed(const MotionParameters& parameters);

  DrivenPath path_;
  simulated_world::Terrain terrain_;
  double cruise_speed_m_per_s_;
  double path_step_m_ = 0.0;
  double duration_s_ = 0.0;
  std::vector<double> arc_m_;  // control points of a uniform cubic B-spline over time
  std::vector<Wave> pitch_, roll_, height_;
};

}  // namespace panvo::simulation

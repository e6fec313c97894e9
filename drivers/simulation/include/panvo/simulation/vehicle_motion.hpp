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
  double turn_rate_rad_per_s = 0.8;    ///< when turning in place
  double max_wait_s = 4.0;             ///< before turning in place: 0 to so long
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
  // A part of the path without a turn in place.
  struct Line {
    std::vector<Eigen::Vector2d> points;
    double begin_m = 0.0, step_m = 0.0;
    double from_s = 0.0;      // from the middle of the turn before it
    double turned_rad = 0.0;  // in place, before it
  };
  Place place(double t_s) const;
  double sum(const std::vector<Wave>& waves, double t_s) const;
  void plan(const MotionParameters& parameters, std::uint64_t seed);
  void follow(const Line& line, const MotionParameters& parameters);
  void turn_in_place(double angle_rad, double wait_s, double rate_rad_per_s, Line& next);

  DrivenPath path_;
  simulated_world::Terrain terrain_;
  double cruise_speed_m_per_s_;
  double duration_s_ = 0.0;
  std::vector<Line> lines_;
  std::vector<double> arc_m_, turned_rad_;  // control points of uniform cubic B-splines over time
  std::vector<Wave> pitch_, roll_, height_;
};

}  // namespace panvo::simulation

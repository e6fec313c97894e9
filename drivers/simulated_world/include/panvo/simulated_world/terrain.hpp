// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace panvo::simulated_world {

/// Smooth terrain height, generated from a seed.
class Terrain {
 public:
  /// `hilliness` 0: flat; 1: hills of about 8 m over 150 m, road grades up to about 8 %.
  Terrain(std::uint64_t seed, double hilliness);

  double height_m(const Eigen::Vector2d& point) const;
  Eigen::Vector3d normal(const Eigen::Vector2d& point) const;  ///< unit, upwards

 private:
  struct Wave {
    Eigen::Vector2d per_m;
    double phase_rad, amplitude_m;
  };
  std::vector<Wave> waves_;
};

}  // namespace panvo::simulated_world

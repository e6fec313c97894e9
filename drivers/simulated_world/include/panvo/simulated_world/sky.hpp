// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "panvo/simulated_world/texture.hpp"

namespace panvo::simulated_world {

/// Daylight, or the light of a night with lamps, in units in which a white matte surface perpendicular to the sunlight
/// has radiance about 1. Nights are some hundred times as bright as real ones, as if the exposure were that much longer.
struct Light {
  Eigen::Vector3f to_sun{0.4f, 0.3f, 0.86f};    ///< unit, world frame
  Eigen::Vector3f sun{0.8f, 0.77f, 0.7f};       ///< of a white surface perpendicular to the sunlight
  Eigen::Vector3f sky{0.22f, 0.26f, 0.34f};     ///< of a white surface that sees the whole upper half
  Eigen::Vector3f ground{0.10f, 0.09f, 0.08f};  ///< of a white surface that sees the whole lower half
  float haze_per_m = 4e-4f;                     ///< rate at which objects fade into the horizon's colour
  bool overcast = false;                        ///< the sky is a closed layer of clouds
  bool lamps = false;                           ///< street lamps are on, and some rooms are lit
  std::uint32_t evening = 0;                    ///< decides which rooms
};

/// The light at an hour of the day, 6 (sunrise, east = +x) to 18, with the fraction of the sun covered by a cloud
/// (0..1).
Light light_at(double hour, double cloud_cover);

/// The same under a closed layer of clouds, which hides the sun.
Light overcast_light_at(double hour);

/// A night without a moon: the sky is lit by the town, under clouds twice as much. `evening` decides which rooms are lit.
Light night_light(bool overcast, std::uint32_t evening);

/// The light in a hall: its lamps, and what walls and roof reflect.
Light hall_light();

/// Radiance of the sky just above the horizon, into which distant objects fade with `haze_per_m`.
Eigen::Vector3f haze(const Light& light);

/// The sky with clouds and, at the horizon, hills and trees far beyond the campus; generated from a seed.
class Sky {
 public:
  explicit Sky(std::uint64_t seed);

  /// Radiance from `direction` (unit, world frame) under that light, averaged over a cone of `spread_rad`, including
  /// the sun's disc and glow.
  Eigen::Vector3f radiance(const Eigen::Vector3f& direction, const Light& light, float spread_rad) const;

 private:
  std::shared_ptr<const Texture> clouds_;   ///< on a plane overhead; alpha: density, red: illumination
  std::shared_ptr<const Texture> horizon_;  ///< by azimuth and elevation; alpha: hills and trees
};

}  // namespace panvo::simulated_world

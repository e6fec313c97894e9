// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/simulated_world/sky.hpp"
#include "panvo/simulation/day.hpp"
#include "panvo/simulation/effects.hpp"

namespace panvo::simulation {

/// The light during a journey: hour of the day, and clouds in front of the sun.
class Weather {
 public:
  /// Clouds come and go with sudden_light, neither on an overcast or wet day nor at night.
  Weather(const Day& day, double duration_s, const Effects& effects, std::uint64_t seed);

  simulated_world::Light light(double t_s) const;
  double hour(double t_s) const;
  double cloud_cover(double t_s) const;  ///< 0..1: fraction of the sun covered by a cloud

  /// A cloud in front of the sun: its shadow comes and goes within half a second.
  struct Cloud {
    double from_s = 0.0, to_s = 0.0;
    double cover = 0.0;
  };
  const std::vector<Cloud>& clouds() const { return clouds_; }

 private:
  Day day_;
  double hours_per_s_;
  std::uint32_t evening_;
  std::vector<Cloud> clouds_;
};

}  // namespace panvo::simulation

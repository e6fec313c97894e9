// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/simulated_world/sky.hpp"
#include "panvo/simulation/effects.hpp"

namespace panvo::simulation {

/// The light during a journey: hour of the day, and clouds in front of the sun.
class Weather {
 public:
  /// `hour` of the day at the start (see light_at); an overcast day has no clouds that come and go.
  Weather(double hour, double duration_s, const Effects& effects, std::uint64_t seed, bool overcast = false);

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
  double hour_, hours_per_s_;
  bool overcast_;
  std::vector<Cloud> clouds_;
};

}  // namespace panvo::simulation

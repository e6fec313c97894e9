// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "panvo/simulation/effects.hpp"
#include "panvo/simulation/sky.hpp"

namespace panvo::simulation {

/// The light over a journey: the hour of the day, and clouds before the sun.
class Weather {
 public:
  /// `hour` of the day at the start (see light_at).
  Weather(double hour, double duration_s, const Effects& effects, std::uint64_t seed);

  Light light(double t_s) const;
  double hour(double t_s) const;
  double cloud_cover(double t_s) const;  ///< 0..1: how much of the sun a cloud takes

  /// A cloud before the sun: its shadow falls within half a second and goes as quickly.
  struct Cloud {
    double from_s = 0.0, to_s = 0.0;
    double cover = 0.0;
  };
  const std::vector<Cloud>& clouds() const { return clouds_; }

 private:
  double hour_, hours_per_s_;
  std::vector<Cloud> clouds_;
};

}  // namespace panvo::simulation

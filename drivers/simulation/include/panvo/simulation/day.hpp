// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/simulated_world/palette.hpp"

namespace panvo::simulation {

/// What distinguishes one day from another on the same campus.
struct Day {
  double hour = 10.5;  ///< of the day at the start, 6 to 18
  simulated_world::Season season = simulated_world::Season::kSummer;
  bool overcast = false;
  bool night = false;                   ///< street lamps instead of the sun; `hour` has no meaning
  bool wet = false;                     ///< after rain, under clouds: roads and pavements mirror; not in snow
  double left_m = 0.0;                  ///< the vehicle keeps that far to the left of its lane's middle
  std::optional<std::uint64_t> seed{};  ///< of vibration, noise, traffic and clouds; nullopt: that of the campus
};

/// Names of the seasons, in order of simulated_world::Season.
inline const std::vector<std::string> kSeasonNames = {"summer", "bare", "snow"};

/// The season of that name. Throws std::invalid_argument, with the valid names, for another one.
simulated_world::Season season_of(const std::string& name);

/// Throws std::invalid_argument if the day contradicts itself.
void check_day(const Day& day);

}  // namespace panvo::simulation

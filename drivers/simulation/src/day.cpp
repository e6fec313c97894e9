// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/day.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace panvo::simulation {

simulated_world::Season season_of(const std::string& name) {
  const auto found = std::find(kSeasonNames.begin(), kSeasonNames.end(), name);
  if (found == kSeasonNames.end()) {
    throw std::invalid_argument(fmt::format("unknown season '{}'; known are {}", name, fmt::join(kSeasonNames, ", ")));
  }
  return static_cast<simulated_world::Season>(found - kSeasonNames.begin());
}

void check_day(const Day& day) {
  if (day.wet && day.season == simulated_world::Season::kSnow) {
    throw std::invalid_argument("season 'snow' contradicts wet: choose one of them");
  }
}

}  // namespace panvo::simulation

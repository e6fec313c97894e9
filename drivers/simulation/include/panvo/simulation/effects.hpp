// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::simulation {

/// What makes life hard for a vision system; all off: a calm sunny day.
struct Effects {
  bool sudden_light = false;    ///< a cloud takes or gives back the sun within half a second, now and then
  bool sun_drift = false;       ///< the sun goes on by two hours of the day over the journey
  bool movers = false;          ///< cars and people
  bool weak_texture = false;    ///< even asphalt and plain walls about the junctions marked so
  bool rain = false;            ///< streaks of drops
  bool smear = false;           ///< dirt on the lenses
  bool dropped_frames = false;  ///< one stereo frame and one panorama in fifty are missing
  bool time_offset = false;     ///< panoramas are stamped 20 ms late

  /// What the panorama's clock is ahead of the stereo camera's and of the truth's, s.
  double panorama_clock_offset_s() const { return time_offset ? 0.02 : 0.0; }
};

struct EffectName {
  std::string_view name, description;
  bool Effects::*member;
};

/// Every effect with its name, in a fixed order.
extern const std::array<EffectName, 8> kEffectNames;

/// The effects of these names (one may hold several, with commas or blanks between); "all" means every one, "none" or nothing no one. Throws std::invalid_argument naming the
/// effect that there is not, and those there are.
Effects effects_of(const std::vector<std::string>& names);

/// The names of those that are on.
std::vector<std::string> names_of(const Effects& effects);

}  // namespace panvo::simulation

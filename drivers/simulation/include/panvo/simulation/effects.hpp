// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace panvo::simulation {

/// Difficulties for vision; all off: a calm sunny day.
struct Effects {
  bool sudden_light = false;    ///< at times, a cloud hides or reveals the sun within half a second
  bool sun_drift = false;       ///< the sun moves by two hours during the journey
  bool movers = false;          ///< cars and people
  bool weak_texture = false;    ///< plain asphalt and walls at the marked junctions
  bool rain = false;            ///< streaks of drops
  bool smear = false;           ///< dirt on the lenses
  bool dropped_frames = false;  ///< 2 % of stereo frames and panoramas are missing
  bool time_offset = false;     ///< panoramas are stamped 20 ms late

  /// Panorama clock minus the clock of the stereo camera and the ground truth, s.
  double panorama_clock_offset_s() const { return time_offset ? 0.02 : 0.0; }
};

struct EffectName {
  std::string_view name, description;
  bool Effects::*member;
};

/// All effects with their names, in a fixed order.
extern const std::array<EffectName, 8> kEffectNames;

/// The effects of these names, each of which may list several, separated by commas or blanks. "all": every effect;
/// "none" or empty: no effect. Throws std::invalid_argument for an unknown name, with the valid ones.
Effects effects_of(const std::vector<std::string>& names);

/// The names of the enabled effects.
std::vector<std::string> names_of(const Effects& effects);

}  // namespace panvo::simulation

// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace panvo::simulation {

const std::array<EffectName, 8> kEffectNames{{
    {"sudden_light", "clouds hide or reveal the sun within half a second", &Effects::sudden_light},
    {"sun_drift", "the sun moves by two hours during the journey", &Effects::sun_drift},
    {"movers", "cars and people, some filling half of the stereo view", &Effects::movers},
    {"weak_texture", "plain asphalt and walls at some junctions", &Effects::weak_texture},
    {"rain", "streaks of drops", &Effects::rain},
    {"smear", "dirt on the lenses", &Effects::smear},
    {"dropped_frames", "2 % of stereo frames and panoramas are missing", &Effects::dropped_frames},
    {"time_offset", "panoramas are stamped 20 ms late", &Effects::time_offset},
}};

namespace {

/// Splits "rain,smear" and "rain smear" into two names.
std::vector<std::string> split(const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (const auto& name : names) {
    std::string part;
    for (const char letter : name + ",") {
      if (letter != ',' && letter != ' ') {
        part += letter;
      } else if (!part.empty()) {
        parts.push_back(std::exchange(part, {}));
      }
    }
  }
  return parts;
}

}  // namespace

Effects effects_of(const std::vector<std::string>& names) {
  Effects effects;
  for (const auto& name : split(names)) {
    if (name == "none") continue;
    const auto is_meant = [&](const EffectName& effect) { return name == "all" || name == effect.name; };
    if (std::none_of(kEffectNames.begin(), kEffectNames.end(), is_meant)) {
      std::string known;
      for (const auto& effect : kEffectNames) known += fmt::format("{}, ", effect.name);
      throw std::invalid_argument(fmt::format("unknown effect '{}'; known: {}all, none", name, known));
    }
    for (const auto& effect : kEffectNames) {
      if (is_meant(effect)) effects.*effect.member = true;
    }
  }
  return effects;
}

std::vector<std::string> names_of(const Effects& effects) {
  std::vector<std::string> names;
  for (const auto& effect : kEffectNames) {
    if (effects.*effect.member) names.emplace_back(effect.name);
  }
  return names;
}

}  // namespace panvo::simulation

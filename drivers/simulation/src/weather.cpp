// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/weather.hpp"

#include <algorithm>

#include "panvo/simulated_world/random.hpp"
#include "smooth_step.hpp"

namespace panvo::simulation {
namespace {

constexpr double kEdgeOfCloud_s = 0.5;
constexpr double kFairWeatherCover = 0.05;

}  // namespace

Weather::Weather(const Day& day, double duration_s, const Effects& effects, std::uint64_t seed)
    : day_(day), evening_(static_cast<std::uint32_t>(simulated_world::Random(seed, "evening").bits())) {
  constexpr double kDriftHours = 2.0;
  hours_per_s_ = effects.sun_drift && duration_s > 0.0 ? kDriftHours / duration_s : 0.0;
  if (!effects.sudden_light || day.overcast || day.wet || day.night) return;
  simulated_world::Random random(seed, "clouds");
  for (double t_s = random.uniform(6.0, 14.0); t_s < duration_s; t_s += random.uniform(12.0, 30.0)) {
    const double length_s = random.uniform(4.0, 12.0);
    clouds_.push_back({t_s, t_s + length_s, random.uniform(0.7, 0.95)});
    t_s += length_s;
  }
}

double Weather::hour(double t_s) const { return day_.hour + hours_per_s_ * t_s; }

double Weather::cloud_cover(double t_s) const {
  double cover = kFairWeatherCover;
  for (const auto& cloud : clouds_) {
    const double share =
        smooth_step((t_s - cloud.from_s) / kEdgeOfCloud_s) - smooth_step((t_s - cloud.to_s) / kEdgeOfCloud_s);
    cover += share * (cloud.cover - kFairWeatherCover);
  }
  return cover;
}

simulated_world::Light Weather::light(double t_s) const {
  if (day_.night) return simulated_world::night_light(day_.overcast || day_.wet, evening_);
  if (day_.overcast || day_.wet) return simulated_world::overcast_light_at(hour(t_s));
  return simulated_world::light_at(hour(t_s), cloud_cover(t_s));
}

}  // namespace panvo::simulation

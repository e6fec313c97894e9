// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "panvo/localizer/localizer.hpp"

/// What passes from journey to journey.
namespace panvo::localizer {

void Localizer::set_self_calibration(const SelfCalibration& measured) {
  const SelfCalibration known = on_a_later_journey(measured, parameters_);
  if (known.panorama_ahead_s) clock_ = ClockOffset(known.panorama_ahead_s->sigma, known.panorama_ahead_s->value);
  if (known.direction_rad) {
    check_.remember_direction(*known.direction_rad);
    mounts_.remember({measured.direction_rad->value, std::pow(measured.direction_rad->sigma, 2)});
  }
  if (known.turn_scale) turn_error_.expect_scale(known.turn_scale->value, known.turn_scale->sigma);
  if (known.scale) graph_.expect_scale(*known.scale);
}

/// Before the clock is known, turns and directions may be those of other times.
SelfCalibration Localizer::self_calibration() const {
  SelfCalibration measured;
  if (is_clock_known() && !is_clock_doubtful_) {
    if (clock_search_.has_found()) {
      measured.panorama_ahead_s = Estimate{clock_.estimate_s(), std::sqrt(clock_.variance_s2())};
    }
    measured.direction_rad = check_.settled_direction();
    measured.turn_scale = turn_error_.measured_scale();
  }
  measured.scale = graph_.measured_scale();
  return measured;
}

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "panvo/localizer/estimate.hpp"
#include "panvo/localizer/localizer_parameters.hpp"

namespace panvo::localizer {

/// What a journey measured of the sensors; each is absent if it did not. Without the lean of the odometry's turns, which
/// changes within a journey.
struct SelfCalibration {
  std::optional<Estimate> panorama_ahead_s;  ///< the panoramic camera's clock, relative to the stereo camera's
  std::optional<Estimate> direction_rad;     ///< of motion, by panoramas minus by odometry: see DirectionOffset
  std::optional<Estimate> turn_scale;        ///< see TurnErrorFilter::scale()
  std::optional<Estimate> scale;             ///< odometry's length over the true one, by satellites
};

/// What that says about a later journey, by standard deviations between what may have changed meanwhile and the prior
/// without it, which is all that is left if a value is wrong. Without what the parameters declare exact.
SelfCalibration on_a_later_journey(const SelfCalibration& measured, const Parameters& parameters);

}  // namespace panvo::localizer

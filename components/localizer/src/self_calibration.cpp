// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/self_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "panvo/vision/angle.hpp"

namespace panvo::localizer {
namespace {

// What may change between two journeys, as standard deviations.
constexpr double kClock_s = 0.05;                         // a video stream buffers an image or two more or less
constexpr double kDirection_rad = 1.0 * vision::kDegree;  // a mount is touched; more shows at once
// Focal length and baseline change by up to 30 and 20 ppm/K: a vehicle in the sun is 40 K warmer than in frost.
constexpr double kScale = 0.0015;

std::optional<Estimate> later(const std::optional<Estimate>& measured, double change_sigma, double prior_sigma) {
  if (!measured || !(prior_sigma > 0.0)) return std::nullopt;
  return Estimate{measured->value, std::min(std::hypot(measured->sigma, change_sigma), prior_sigma)};
}

}  // namespace

SelfCalibration on_a_later_journey(const SelfCalibration& measured, const Parameters& parameters) {
  return {later(measured.panorama_ahead_s, kClock_s, parameters.clock_sigma_s),
          later(measured.direction_rad, kDirection_rad, parameters.mounting_sigma_deg * vision::kDegree),
          later(measured.turn_scale, kScale, parameters.turn_scale_sigma),
          later(measured.scale, kScale, parameters.scale_sigma)};
}

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/speed_witness.hpp"

#include <cmath>
#include <vector>

#include "panvo/vision/median.hpp"

namespace panvo::localizer {
namespace {

constexpr double kMinLength_m = 0.5;     // for a defined parallax per metre
constexpr double kRecent_m = 6.0;        // way on which objects beside it stand about equally far away
constexpr std::size_t kFewest = 3;       // stretches: of the median, one may be wrong
constexpr double kMeasured_rad = 0.005;  // error of a parallax: a pixel of a panorama
// Scenery changes: two of three stretches of some metres show between 1 / 1.35 and 1.35 times the parallax per metre of
// those just before, nine of ten between 1 / 1.8 and 1.8 times. The vehicle cannot have jumped as odometry says, so
// panoramas that tend to contradict it are believed, but only clear ones that agree.
const double kTendency = std::log(1.5), kClear = std::log(1.8);
constexpr double kNearer = 0.5;  // half-way between two explanations

}  // namespace

void SpeedWitness::add(double at_m, double length_m, double parallax_rad) {
  if (length_m < kMinLength_m) return;
  stretches_.push_back({at_m, std::abs(parallax_rad) / length_m});
  while (stretches_.size() > kFewest && stretches_.front().at_m < at_m - kRecent_m) stretches_.pop_front();
}

/// Compares logarithms: scenery changes the parallax by a factor.
SpeedVerdict SpeedWitness::judge(double parallax_rad, double said_m, std::optional<double> otherwise_m) const {
  if (stretches_.size() < kFewest) return SpeedVerdict::kUnclear;
  const double usual_rad_per_m = this->usual_rad_per_m();
  const double expected_rad = usual_rad_per_m * said_m + kMeasured_rad;
  const double seen = std::log((std::abs(parallax_rad) + kMeasured_rad) / expected_rad);
  const bool is_usual = std::abs(seen) < kClear;
  if (!otherwise_m) return is_usual ? SpeedVerdict::kAgrees : SpeedVerdict::kUnclear;
  const double otherwise = std::log((usual_rad_per_m * *otherwise_m + kMeasured_rad) / expected_rad);
  const bool is_nearer = seen / otherwise < kNearer;
  if (std::abs(otherwise) > kTendency && !is_nearer) return SpeedVerdict::kContradicts;
  return std::abs(otherwise) > kClear && is_nearer && is_usual ? SpeedVerdict::kAgrees : SpeedVerdict::kUnclear;
}

std::optional<SpeedWitness::Length> SpeedWitness::length(double parallax_rad) const {
  if (stretches_.size() < kFewest || !(usual_rad_per_m() > 0.0)) return std::nullopt;
  return Length{std::abs(parallax_rad) / usual_rad_per_m(), kMeasured_rad / usual_rad_per_m()};
}

double SpeedWitness::usual_rad_per_m() const {
  std::vector<double> per_metre;
  for (const auto& stretch : stretches_) per_metre.push_back(stretch.parallax_rad_per_m);
  return vision::median(per_metre);
}

}  // namespace panvo::localizer

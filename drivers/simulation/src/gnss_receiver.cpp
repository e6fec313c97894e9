// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulation/gnss_receiver.hpp"

#include <cmath>

namespace panvo::simulation {
namespace {

constexpr double kShortestStretch_m = 20.0, kLongestStretch_m = 60.0;
const Eigen::Vector3d kAxes(1.0, 1.0, 2.0);  // all satellites are above: heights are worse

}  // namespace

GnssReceiver::GnssReceiver(const GnssErrors& errors, std::uint64_t seed)
    : errors_(errors), random_(seed, "satellites"), slow_m_(errors.slow_error_m * noise()) {}

std::optional<GnssReceiver::Fix> GnssReceiver::step(std::int64_t stamp_ns, const Eigen::Vector3d& true_world_m) {
  const auto period_ns = static_cast<std::int64_t>(std::llround(1e9 / errors_.rate_hz));
  if (last_ns_ && stamp_ns / period_ns == *last_ns_ / period_ns) return std::nullopt;
  if (last_ns_) {
    const double keep = std::exp(-1e-9 * static_cast<double>(stamp_ns - *last_ns_) / errors_.slow_error_s);
    slow_m_ = keep * slow_m_ + std::sqrt(1.0 - keep * keep) * errors_.slow_error_m * noise();
    begin_stretches((true_world_m - last_m_).norm());
  }
  last_ns_ = stamp_ns;
  last_m_ = true_world_m;
  Fix fix{stamp_ns, outage_left_m_ <= 0.0, true_world_m + slow_m_ + errors_.noise_m * noise(),
          std::hypot(errors_.noise_m, errors_.slow_error_m) * kAxes};
  if (reflection_left_m_ > 0.0) fix.world_m += reflection_m_;
  return fix;
}

void GnssReceiver::begin_stretches(double way_m) {
  reflection_left_m_ -= way_m;
  outage_left_m_ -= way_m;
  if (random_.chance(1e-3 * way_m * errors_.reflections_per_km)) {
    reflection_left_m_ = random_.uniform(kShortestStretch_m, kLongestStretch_m);
    reflection_m_ = errors_.reflection_m * noise();
  }
  if (random_.chance(1e-3 * way_m * errors_.outages_per_km)) {
    outage_left_m_ = random_.uniform(kShortestStretch_m, kLongestStretch_m);
  }
}

Eigen::Vector3d GnssReceiver::noise() {
  const double x = random_.gaussian(), y = random_.gaussian(), z = random_.gaussian();
  return Eigen::Vector3d(x, y, z).cwiseProduct(kAxes);
}

}  // namespace panvo::simulation

// SPDX-License-Identifier: Apache-2.0
#include "panorama_queue.hpp"

namespace panvo::localizer {

std::int64_t stamp_of(const PanoramaFact& fact) {
  struct {
    std::int64_t operator()(const AzimuthMeasurement& azimuth) const { return azimuth.to_ns; }
    std::int64_t operator()(const LandmarkSighting& sighting) const { return sighting.stamp_ns; }
    std::int64_t operator()(const Built& built) const { return built.stamp_ns; }
  } const stamp;
  return std::visit(stamp, fact);
}

bool PanoramaQueue::push(const PanoramaFact& fact) {
  waiting_.push_back(fact);
  if (waiting_.size() <= kMaxWaiting) return true;
  waiting_.pop_front();
  return false;
}

std::optional<PanoramaFact> PanoramaQueue::next(const Localizer& localizer) {
  for (auto at = waiting_.begin(); at != waiting_.end(); ++at) {
    const std::int64_t stamp_ns = stamp_of(*at);
    if (localizer.reaches(stamp_ns)) {
      const PanoramaFact fact = *at;
      waiting_.erase(at);
      return fact;
    }
    if (stamp_ns - localizer.latest().stamp_ns < kFarAhead_ns) break;
  }
  return std::nullopt;
}

}  // namespace panvo::localizer

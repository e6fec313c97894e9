// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/junction_score.hpp"

#include <algorithm>

namespace panvo::evaluation {

double JunctionScore::precision() const {
  const int all = found + static_cast<int>(wrong.size());
  return all == 0 ? 1.0 : static_cast<double>(found) / all;
}

double JunctionScore::recall() const {
  return found + missed == 0 ? 1.0 : static_cast<double>(found) / (found + missed);
}

JunctionScore score_junctions(const std::vector<RecordedPanorama>& panoramas,
                              const std::map<int, JourneyPlace>& junctions,
                              const std::vector<landmark_builder::PassedJunction>& detections, double radius_m) {
  JunctionScore score;
  for (const auto& [number, junction] : junctions) {
    if (junction.roads < 3) continue;
    bool is_inside = false;
    for (const RecordedPanorama& panorama : panoramas) {
      const double distance_m = (panorama.world_from_base.translation().head<2>() - junction.position_m).norm();
      if (distance_m > radius_m) {
        is_inside = false;
        continue;
      }
      if (!is_inside) score.visits.push_back({number, panorama.stamp_ns, panorama.stamp_ns, distance_m, false, 0});
      is_inside = true;
      auto& visit = score.visits.back();
      visit.to_ns = panorama.stamp_ns;
      visit.nearest_m = std::min(visit.nearest_m, distance_m);
    }
  }
  std::sort(score.visits.begin(), score.visits.end(),
            [](const auto& a, const auto& b) { return a.from_ns < b.from_ns; });
  for (auto& visit : score.visits) {
    visit.is_cut = visit.from_ns == panoramas.front().stamp_ns || visit.to_ns == panoramas.back().stamp_ns;
  }
  for (const auto& detection : detections) {
    const auto visit = std::find_if(score.visits.begin(), score.visits.end(), [&](const auto& candidate) {
      return detection.nearest_stamp_ns >= candidate.from_ns && detection.nearest_stamp_ns <= candidate.to_ns;
    });
    if (visit == score.visits.end() || (visit->detections > 0)) {
      score.wrong.push_back(detection);
    }
    if (visit != score.visits.end()) ++visit->detections;
  }
  for (const auto& visit : score.visits) {
    if (visit.is_cut) continue;
    (visit.detections > 0 ? score.found : score.missed) += 1;
  }
  return score;
}

}  // namespace panvo::evaluation

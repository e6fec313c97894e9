// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "panvo/evaluation/journey_recording.hpp"
#include "panvo/landmark_builder/junction_filter.hpp"

namespace panvo::evaluation {

/// Score of detected junctions against the listed ones. A visit is a stretch of the journey within `radius_m` of a
/// listed junction where at least three roads meet; bends (two) and road ends (one) do not count. A visit is found by
/// the first detection whose panorama was taken during it. Any other detection is false, including a second one of the
/// same visit. Visits cut by the start or end of the recording count neither as found nor as missed.
struct JunctionScore {
  struct Visit {
    int junction = 0;
    std::int64_t from_ns = 0, to_ns = 0;
    double nearest_m = 0.0;
    bool is_cut = false;  ///< by the start or end of the recording
    int detections = 0;
  };
  std::vector<Visit> visits;
  std::vector<landmark_builder::PassedJunction> wrong;
  int found = 0, missed = 0;

  double precision() const;
  double recall() const;
};

/// `panoramas`: with their true poses, in order of time, not empty. `junctions`: the listed ones, by number.
JunctionScore score_junctions(const std::vector<RecordedPanorama>& panoramas,
                              const std::map<int, JourneyPlace>& junctions,
                              const std::vector<landmark_builder::PassedJunction>& detections, double radius_m);

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/landmark_builder/junction_filter.hpp"
#include "recording.hpp"

namespace panvo::landmark_builder {

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
  std::vector<PassedJunction> wrong;
  int found = 0, missed = 0;

  double precision() const;
  double recall() const;
};

JunctionScore score_junctions(const Recording& recording, const std::vector<PassedJunction>& detections,
                              double radius_m);

}  // namespace panvo::landmark_builder

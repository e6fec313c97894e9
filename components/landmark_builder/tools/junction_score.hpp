// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "panvo/landmark_builder/junction_filter.hpp"
#include "recording.hpp"

namespace panvo::landmark_builder {

/// Found junctions against the listed ones. The rule: a visit is a stretch of the journey within `radius_m` of a listed
/// junction where three roads or more meet; bends (two) and ends of roads (one) are no junctions. A visit is found by the first
/// detection whose panorama was taken during it. Any other detection is false: also a second one of the same visit. A visit
/// that the recording begins or ends in, so that the junction is not passed, counts neither way.
struct JunctionScore {
  struct Visit {
    int junction = 0;
    std::int64_t from_ns = 0, to_ns = 0;
    double nearest_m = 0.0;
    bool is_cut = false;  ///< by the recording's begin or end
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

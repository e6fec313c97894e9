// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/consistency.hpp"
#include "panvo/evaluation/journey_revisits.hpp"
#include "panvo/evaluation/pose_error.hpp"
#include "panvo/evaluation/statistics.hpp"

namespace panvo::evaluation {

/// One odometry over a whole journey. Errors as published and from the common start, unless named otherwise.
struct PathScore {
  std::string name;
  std::vector<PoseError> errors;        ///< at each pose that has truth
  Summary ate_m;                        ///< of the position error
  Summary flat_m;                       ///< of its horizontal part, the paper's "2D"
  Summary heading_rad;                  ///< of the absolute heading error
  std::optional<Summary> ate_se3_m;     ///< after the best rigid alignment
  double final_m = 0.0, worst_m = 0.0;  ///< horizontal
  double worst_at_m = 0.0;              ///< way travelled there
  double percent_of_way = 0.0;          ///< 2D root mean square, of the way travelled
};

/// Binocular and enhanced odometry side by side.
struct PathScores {
  double travelled_m = 0.0;
  double duration_s = 0.0;
  PathScore binocular, enhanced;
  double ratio = 0.0;  ///< 2D root mean square of the enhanced path as a share of the binocular one's
  std::optional<PoseConsistency> consistency;
  /// Way in which the localizer said that it does not know yet where in the map it is. The enhanced path is scored without it.
  double unlocated_m = 0.0;
};

PathScores score_paths(const JourneyFrames& frames);

}  // namespace panvo::evaluation

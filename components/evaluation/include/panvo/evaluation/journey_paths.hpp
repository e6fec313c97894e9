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

/// Errors of one odometry over a whole journey, of poses as published, with aligned starts unless stated otherwise.
struct PathScore {
  std::string name;
  std::vector<PoseError> errors;        ///< of each pose with ground truth
  Summary ate_m;                        ///< of the position error
  Summary flat_m;                       ///< of its horizontal part ("2D" in the paper)
  Summary heading_rad;                  ///< of the absolute heading error
  std::optional<Summary> ate_se3_m;     ///< after the best rigid alignment
  double final_m = 0.0, worst_m = 0.0;  ///< horizontal
  double worst_at_m = 0.0;              ///< distance travelled at the largest error
  double percent_of_way = 0.0;          ///< 2D RMSE in percent of the distance travelled
};

/// Binocular and enhanced odometry side by side.
struct PathScores {
  double travelled_m = 0.0;
  double duration_s = 0.0;
  PathScore binocular, enhanced;
  double ratio = 0.0;  ///< 2D RMSE of the enhanced path divided by that of the binocular path
  std::optional<PoseConsistency> consistency;
  /// Distance travelled in state "unlocated". The enhanced path is scored without it.
  double unlocated_m = 0.0;
};

PathScores score_paths(const JourneyFrames& frames);

}  // namespace panvo::evaluation

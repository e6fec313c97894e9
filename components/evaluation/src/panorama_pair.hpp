// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/journey_recording.hpp"

namespace panvo::evaluation {

/// A landmark's panorama and that of a revisit, the second turned by the heading so that far things stand one above the other.
/// Both are a band about the horizon, 1080 columns.
struct PanoramaPair {
  struct Match {
    Eigen::Vector2d landmark_px, revisit_px;  ///< in the bands; the second after turning
  };
  int columns = 0, rows = 0;
  std::string landmark_jpeg, revisit_jpeg;
  std::vector<Match> inliers;  ///< SIFT matches that agree on one motion [Lu2015 5.2]
  int matches = 0;             ///< of which they are
};

/// `heading_rad`: yaw at the revisit minus yaw at the landmark, left positive. Throws InputError for an image that is none.
PanoramaPair panorama_pair(const std::filesystem::path& landmark, const std::filesystem::path& revisit,
                           double heading_rad);

/// Of the stamp, or the nearest within 0.15 s; nullptr where the recording has none then.
const RecordedPanorama* panorama_near(const JourneyRecording& recording, std::int64_t stamp_ns);

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/journey_recording.hpp"

namespace panvo::evaluation {

/// The panoramas of a landmark and of a revisit. The second is rotated by the heading so that distant objects line up.
/// Both are a band around the horizon, 1080 columns.
struct PanoramaPair {
  struct Match {
    Eigen::Vector2d landmark_px, revisit_px;  ///< in the bands; the second after the rotation
  };
  int columns = 0, rows = 0;
  std::string landmark_jpeg, revisit_jpeg;
  std::vector<Match> inliers;  ///< SIFT matches consistent with one motion [Lu2015 5.2]
  int matches = 0;             ///< number of all SIFT matches
};

/// `heading_rad`: yaw at the revisit minus yaw at the landmark, left positive. Throws InputError for an invalid image.
PanoramaPair panorama_pair(const std::filesystem::path& landmark, const std::filesystem::path& revisit,
                           double heading_rad);

/// The band of one panorama, rotated so that distant objects move to the left by `heading_rad`. Throws InputError for an
/// invalid image.
cv::Mat3b panorama_band(const std::filesystem::path& file, double heading_rad = 0.0);

/// The panorama nearest to the stamp, within 0.15 s; nullptr if there is none.
const RecordedPanorama* panorama_near(const JourneyRecording& recording, std::int64_t stamp_ns);

}  // namespace panvo::evaluation

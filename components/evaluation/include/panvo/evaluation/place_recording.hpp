// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "panvo/evaluation/journey_recording.hpp"

namespace panvo::evaluation {

/// A pass by a junction, as listed in sequence.yaml.
struct RecordedVisit {
  int place = 0;              ///< number of the junction
  std::int64_t stamp_ns = 0;  ///< of the closest approach
  std::size_t panorama = 0;   ///< index of the panorama nearest to that stamp
};

/// Panoramas with ground truth and a list of the places passed: an EuRoC/ASL data set (cam2) with a sequence.yaml.
struct PlaceRecording {
  std::filesystem::path folder;
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  std::vector<RecordedPanorama> panoramas;  ///< in order of stamps
  std::vector<RecordedVisit> visits;        ///< in order of stamps
};

/// Throws InputError (file, problem, remedy) if anything is missing or invalid. Images are not opened.
PlaceRecording read_place_recording(const std::filesystem::path& folder);

/// Removes panoramas that cannot be read and passes each to `report` with the reason; visits get the nearest that is left.
/// Throws InputError if none is.
void drop_unreadable(PlaceRecording& recording, const std::function<void(const std::string&)>& report);

/// Reads a panorama, CV_8UC1, 1080x540. Throws InputError if it cannot be decoded or is not 2:1.
cv::Mat read_panorama(const RecordedPanorama& panorama);

}  // namespace panvo::evaluation

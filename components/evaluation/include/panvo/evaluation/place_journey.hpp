// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "panvo/evaluation/place_table.hpp"
#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"

namespace panvo::evaluation {

struct JourneySettings {
  landmarks::DescriptionParameters description;
  landmarks::KeypointParameters keypoints;
  position_corrector::MatchingParameters matching;
  std::uint64_t seed = 1;
  double same_place_m = 15.0;  ///< a match with a landmark within this distance is right
  /// Standard deviation of the noisy position passed to the matcher, m; nullopt: no position, the matcher searches all
  /// landmarks.
  std::optional<double> position_sigma_m;
};

/// A landmark that the matcher reported as passed.
struct JourneyMatch {
  std::size_t panorama = 0;
  std::size_t known = 0;           ///< index of the known place
  double offset_m = 0.0;           ///< true distance to it
  double heading_error_rad = 0.0;  ///< of the reported heading
  double position_error_m = 0.0;   ///< of the pose relative to the landmark, horizontal
  bool is_right = false;           ///< the vehicle is near that place
  position_corrector::LandmarkMatch match;
};

/// Result of matching every panorama of a journey with a library of the known places.
struct JourneyScore {
  std::vector<JourneyMatch> matches;
  std::vector<bool> found;  ///< for each revisit of the task
  int wrong = 0;
};

/// Builds landmarks at the first visits of `first`, with points from the neighbouring panoramas, and matches all
/// panoramas of `then`. If both are the same recording, a landmark is known only after its first visit. Calls
/// `on_panorama(i, count)` before each panorama.
JourneyScore match_journey(const PlaceTask& task, const PlaceRecording& first, const PlaceRecording& then,
                           const JourneySettings& settings,
                           const std::function<void(std::size_t, std::size_t)>& on_panorama);

/// Builds a landmark from a panorama of a recording, with its true pose.
landmarks::PanoramicLandmark recorded_landmark(const PlaceRecording& recording, std::size_t panorama,
                                               const landmarks::PanoramaDescriber& describer,
                                               const landmarks::KeypointParameters& keypoints);

}  // namespace panvo::evaluation

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
  /// Standard deviation of the position that the matcher is told, m, and how wrong it is; nullopt: it is told none and searches all.
  std::optional<double> position_sigma_m;
};

/// A landmark that was reported as passed.
struct JourneyMatch {
  std::size_t panorama = 0;
  std::size_t known = 0;           ///< which of the known places
  double offset_m = 0.0;           ///< true distance to it
  double heading_error_rad = 0.0;  ///< of the heading it reported
  double position_error_m = 0.0;   ///< of its pose from the landmark, horizontal
  bool is_right = false;           ///< the vehicle is near that place
  position_corrector::LandmarkMatch match;
};

/// Every panorama of a journey through the matcher, against a library of the known places.
struct JourneyScore {
  std::vector<JourneyMatch> matches;
  std::vector<bool> found;  ///< for each revisit of the task
  int wrong = 0;
};

/// Places of `first` become landmarks where they were passed first, with points from the neighbouring panoramas; if `then` is
/// the same recording, from that moment on. `on_panorama(i, count)` is called before each.
JourneyScore match_journey(const PlaceTask& task, const PlaceRecording& first, const PlaceRecording& then,
                           const JourneySettings& settings,
                           const std::function<void(std::size_t, std::size_t)>& on_panorama);

/// A landmark of a panorama of a recording, its pose the true one.
landmarks::PanoramicLandmark recorded_landmark(const PlaceRecording& recording, std::size_t panorama,
                                               const landmarks::PanoramaDescriber& describer,
                                               const landmarks::KeypointParameters& keypoints);

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#include "place_recognition.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "panvo/landmarks/panorama_check.hpp"

namespace panvo::python {
namespace {

using position_corrector::LandmarkMatcher;
using position_corrector::MatchState;

}  // namespace

PlaceRecogniser::PlaceRecogniser(const PlaceParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), seed_(seed), describer_(parameters.description, seed) {}

Place PlaceRecogniser::describe(const cv::Mat& panorama) const {
  if (const auto fault = landmarks::find_fault(panorama)) throw std::invalid_argument("panorama: " + *fault);
  return {describer_.describe(panorama), landmarks::detect_keypoints(panorama, parameters_.keypoints),
          std::make_shared<const landmarks::DescriptionBasis>(describer_.basis())};
}

PlaceMatch PlaceRecogniser::match(const cv::Mat& panorama, std::span<const Place* const> places) const {
  landmarks::LandmarkLibrary library(nullptr, describer_.basis().limits());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!(places[i]->basis->parameters == parameters_.description) || places[i]->basis->seed != seed_) {
      throw std::invalid_argument(
          fmt::format("places: number {} was described with other parameters or another seed", i));
    }
    landmarks::PanoramicLandmark landmark;
    landmark.description = places[i]->description;
    library.add(std::move(landmark));  // ids are 1, 2, ...
  }
  // Without metric points the matcher finds the candidate, but no pose of it.
  LandmarkMatcher matcher(parameters_.matching, parameters_.keypoints, describer_);
  const auto found = matcher.match({0, panorama, 0.0, std::nullopt}, library);
  PlaceMatch match;
  match.reason = found.reason;
  if (found.landmark_id == 0) return match;
  match.index = found.landmark_id - 1;
  match.heading_rad = found.heading_rad;
  match.distance = found.small_distance;
  if (found.state != MatchState::kRejected) return match;
  const auto geometry = position_corrector::estimate_five_point_motion(
      landmarks::detect_keypoints(panorama, parameters_.keypoints), places[match.index]->keypoints, found.heading_rad,
      parameters_.geometry);
  match.inliers = geometry.inliers;
  match.is_known = geometry.motion.has_value();
  match.reason = geometry.reason;
  return match;
}

}  // namespace panvo::python

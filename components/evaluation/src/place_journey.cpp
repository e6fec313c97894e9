// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/place_journey.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "panvo/landmark_builder/keypoint_triangulation.hpp"
#include "panvo/landmarks/landmark_library.hpp"
#include "panvo/vision/equirectangular.hpp"

namespace panvo::evaluation {
namespace {

constexpr double kSamePass_m = 20.0;         // distance travelled from the nearest point
constexpr double kNearestNeighbour_m = 0.7;  // distance travelled between panoramas used for triangulation
constexpr double kMaxNeighbour_m = 4.5;

double flat_norm(const Eigen::Vector3d& vector) { return vector.head<2>().norm(); }

JourneyMatch judged(const position_corrector::LandmarkMatch& match, std::size_t panorama, std::size_t known,
                    const RecordedPanorama& now, const landmarks::PanoramicLandmark& landmark, double same_place_m) {
  JourneyMatch judged;
  judged.match = match;
  judged.panorama = panorama;
  judged.known = known;
  judged.offset_m = flat_norm(now.world_from_base.translation() - landmark.map_from_base.translation());
  judged.is_right = judged.offset_m <= same_place_m;
  judged.heading_error_rad = vision::wrap(
      match.heading_rad - (yaw_of(now.world_from_base) - yaw_of(landmark.map_from_base)), 2.0 * std::numbers::pi);
  if (match.pose) {
    const Eigen::Isometry3d map_from_base = landmark.map_from_base * landmark.base_from_panorama *
                                            match.pose->landmark_from_panorama * landmark.base_from_panorama.inverse();
    judged.position_error_m = flat_norm(map_from_base.translation() - now.world_from_base.translation());
  }
  return judged;
}

}  // namespace

JourneyScore match_journey(const PlaceTask& task, const PlaceRecording& first, const PlaceRecording& then,
                           const JourneySettings& settings,
                           const std::function<void(std::size_t, std::size_t)>& on_panorama) {
  const landmarks::PanoramaDescriber describer(settings.description, settings.seed);
  position_corrector::LandmarkMatcher matcher(settings.matching, settings.keypoints, describer);
  landmarks::LandmarkLibrary library;
  std::map<std::uint32_t, std::size_t> known_by_id;
  const auto add = [&](std::size_t known) {
    const auto id = library.add(recorded_landmark(first, task.places[known].panorama, describer, settings.keypoints));
    known_by_id[id] = known;
    matcher.added(id);
  };
  const bool is_same = &first == &then;
  if (!is_same) {
    for (std::size_t i = 0; i < task.places.size(); ++i) add(i);
  }

  std::mt19937_64 random(settings.seed);
  const auto uniform = [&] { return 2.0 * static_cast<double>(random() >> 11U) * 0x1p-53 - 1.0; };
  JourneyScore score;
  score.found.assign(task.revisits.size(), false);
  for (std::size_t i = 0; i < then.panoramas.size(); ++i) {
    on_panorama(i, then.panoramas.size());
    const auto& panorama = then.panoramas[i];
    position_corrector::PanoramaFrame frame;
    frame.stamp_ns = panorama.stamp_ns;
    frame.panorama = read_panorama(panorama);
    frame.travelled_m = panorama.travelled_m;
    if (settings.position_sigma_m) {
      const double sigma_m = *settings.position_sigma_m;
      const Eigen::Vector3d error{sigma_m * uniform(), sigma_m * uniform(), 0.0};
      frame.prior = {panorama.world_from_base.translation() + error, sigma_m};
    }
    const auto match = matcher.match(frame, library);
    if (match.state == position_corrector::MatchState::kMatched) {
      const auto at = std::find_if(then.panoramas.begin(), then.panoramas.end(),
                                   [&](const RecordedPanorama& other) { return other.stamp_ns == match.stamp_ns; });
      const auto index = static_cast<std::size_t>(at - then.panoramas.begin());
      const auto judgement = judged(match, index, known_by_id.at(match.landmark_id), *at,
                                    *library.find(match.landmark_id), settings.same_place_m);
      score.matches.push_back(judgement);
      score.wrong += judgement.is_right ? 0 : 1;
      for (std::size_t k = 0; k < task.revisits.size(); ++k) {
        const auto& revisit = task.revisits[k];
        const double way_m = at->travelled_m - then.panoramas[revisit.panorama].travelled_m;
        if (revisit.known == judgement.known && judgement.is_right && std::abs(way_m) <= kSamePass_m) {
          score.found[k] = true;
        }
      }
    }
    for (std::size_t k = 0; is_same && k < task.places.size(); ++k) {
      if (task.places[k].panorama == i) add(k);
    }
  }
  return score;
}

landmarks::PanoramicLandmark recorded_landmark(const PlaceRecording& recording, std::size_t panorama,
                                               const landmarks::PanoramaDescriber& describer,
                                               const landmarks::KeypointParameters& keypoints) {
  const auto& at = recording.panoramas[panorama];
  const auto image = read_panorama(at);
  landmarks::PanoramicLandmark landmark;
  landmark.stamp_ns = at.stamp_ns;
  landmark.map_from_base = at.world_from_base;
  landmark.base_from_panorama = recording.base_from_panorama;
  landmark.description = describer.describe(image);
  landmark.keypoints = detect_keypoints(image, keypoints);
  std::vector<landmark_builder::NeighbourPanorama> neighbours;
  const auto consider = [&](std::size_t i) {
    const auto& near = recording.panoramas[i];
    const double way_m = std::abs(near.travelled_m - at.travelled_m);
    if (way_m < kNearestNeighbour_m || way_m > kMaxNeighbour_m) return way_m <= kMaxNeighbour_m;
    const Eigen::Isometry3d world_from_landmark = at.world_from_base * recording.base_from_panorama;
    neighbours.push_back({world_from_landmark.inverse() * near.world_from_base * recording.base_from_panorama,
                          detect_keypoints(read_panorama(near), keypoints)});
    return true;
  };
  for (std::size_t i = panorama; i-- > 0 && consider(i);) {
  }
  for (std::size_t i = panorama + 1; i < recording.panoramas.size() && consider(i); ++i) {
  }
  triangulate_keypoints(landmark.keypoints, neighbours, {});
  return landmark;
}

}  // namespace panvo::evaluation

// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/place_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "panvo/vision/angle.hpp"

namespace panvo::stereo_places {
namespace {

using landmarks::PanoramicLandmark;

// Places of one stretch share the odometry's drift, so that views which show two of them must agree on the position.
constexpr std::int64_t kStretch_ns = 20'000'000'000;
constexpr double kContradiction_m = 1.5;
constexpr double kContradiction_rad = 6.0 * vision::kDegree;

Eigen::Isometry3d map_from_place(const PanoramicLandmark& landmark) {
  return landmark.map_from_base * landmark.base_from_panorama;
}

/// Whether two places put the view at different poses in the map.
bool contradict(const FoundPlace& a, const FoundPlace& b) {
  if (std::abs(a.landmark->stamp_ns - b.landmark->stamp_ns) > kStretch_ns) return false;
  const Eigen::Isometry3d apart = (map_from_place(*a.landmark) * a.pose.landmark_from_panorama).inverse() *
                                  map_from_place(*b.landmark) * b.pose.landmark_from_panorama;
  return apart.translation().norm() > kContradiction_m || vision::so3_log(apart.linear()).norm() > kContradiction_rad;
}

position_corrector::PanoramaPoseParameters pose_parameters(const SearchParameters& search,
                                                           const vision::PinholeCamera& camera, int reduction) {
  const double pixel_deg = reduction / camera.fx / vision::kDegree;
  position_corrector::PanoramaPoseParameters pose;
  pose.azimuth_window_deg = 180.0;
  pose.descriptor_ratio = search.evidence.descriptor_ratio;
  pose.bearing_sigma_deg = search.bearing_sigma_px * pixel_deg;
  pose.inlier_angle_deg = search.inlier_sigmas * pose.bearing_sigma_deg;
  pose.iterations = search.iterations;
  pose.min_inliers = pose.min_weak_inliers = search.min_inliers;
  pose.min_inliers_share = search.min_inliers_share;
  pose.min_sectors = 1;
  pose.max_turn_deg = search.max_turn_deg;
  pose.max_tilt_deg = search.max_tilt_deg;
  pose.max_offset_m = search.max_offset_m;
  return pose;
}

}  // namespace

PlaceSearch::PlaceSearch(const SearchParameters& parameters, const vision::PinholeCamera& camera, int reduction,
                         vision::StageObserver* observer)
    : parameters_(parameters),
      pose_(pose_parameters(parameters, camera, reduction)),
      field_of_view_rad_(std::atan(camera.cx / camera.fx) + std::atan((camera.width - camera.cx) / camera.fx)),
      observer_(observer) {}

void PlaceSearch::add(const PanoramicLandmark& landmark) { ranking_.add(landmark.id, landmark.keypoints); }

bool PlaceSearch::is_near(const PanoramicLandmark& landmark, const ViewPrior& prior) const {
  const Eigen::Isometry3d place = map_from_place(landmark);
  const double radius_m = parameters_.radius_m + parameters_.radius_sigmas * prior.sigma_m;
  if ((place.translation() - prior.map_from_view.translation()).head<2>().norm() > radius_m) return false;
  const double turn_rad =
      std::acos(std::clamp(place.linear().col(2).dot(prior.map_from_view.linear().col(2)), -1.0, 1.0));
  return turn_rad <= parameters_.max_turn_deg * vision::kDegree + parameters_.radius_sigmas * prior.sigma_rad;
}

SearchResult PlaceSearch::find(std::span<const landmarks::Keypoint> view, const landmarks::LandmarkLibrary& library,
                               const std::optional<ViewPrior>& prior, std::optional<std::uint32_t> first,
                               const std::function<bool(std::uint32_t)>& is_asked) const {
  SearchResult result;
  std::set<std::uint32_t> near;
  for (const auto* landmark : library.all()) {
    if (is_asked(landmark->id) && (!prior || is_near(*landmark, *prior))) near.insert(landmark->id);
  }
  result.candidates = static_cast<int>(near.size());
  if (near.empty()) {
    result.reason = library.empty() ? "no landmarks yet" : "no landmark near the position at a like heading";
    return result;
  }
  std::vector<std::uint32_t> ranked;
  {
    const vision::Stage stage(observer_, "rank");
    const auto most = static_cast<std::size_t>(prior ? parameters_.max_verified : parameters_.max_verified_unlocated);
    if (first && near.contains(*first)) ranked.push_back(*first);
    for (const auto& one : ranking_.rank(
             view, [&](std::uint32_t id) { return near.contains(id); }, most)) {
      if (one.id != first) ranked.push_back(one.id);
    }
  }
  const double log10_places = std::log10(static_cast<double>(library.size()));
  std::vector<FoundPlace> found;
  for (const auto id : ranked) {
    const vision::Stage stage(observer_, "verify");
    std::string reason;
    ++result.verified;
    auto place = verify(view, *library.find(id), library.keypoints(id), log10_places, reason);
    if (place) {
      found.push_back(*place);
    } else if (result.nearest == 0) {
      result.nearest = id;
      result.reason = fmt::format("landmark {}: {}", id, reason);
    }
  }
  if (found.empty()) return result;
  auto best = std::min_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.evidence.log10_expected < b.evidence.log10_expected;
  });
  result.nearest = best->landmark->id;
  for (const auto& other : found) {
    if (!contradict(*best, other)) continue;
    result.reason = fmt::format("landmarks {} and {} give different positions", best->landmark->id, other.landmark->id);
    return result;
  }
  if (first && found.front().landmark->id == *first) best = found.begin();
  result.nearest = best->landmark->id;
  result.reason.clear();
  result.place = *best;
  return result;
}

std::optional<FoundPlace> PlaceSearch::verify(std::span<const landmarks::Keypoint> view,
                                              const PanoramicLandmark& landmark,
                                              std::span<const landmarks::Keypoint> keypoints, double log10_places,
                                              std::string& reason) const {
  const auto estimated = position_corrector::estimate_panorama_pose(view, keypoints, 0.0, pose_);
  reason = estimated.reason;
  if (!estimated.pose) return std::nullopt;
  const FoundPlace found{&landmark, *estimated.pose, estimated.inliers,
                         judge_view(view, keypoints, estimated.pose->landmark_from_panorama, field_of_view_rad_,
                                    log10_places, parameters_.evidence)};
  reason = found.evidence.objection;
  if (!reason.empty()) return std::nullopt;
  return found;
}

}  // namespace panvo::stereo_places

// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/recognition.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "panvo/landmarks/heading_search.hpp"
#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/panorama_check.hpp"
#include "panvo/position_corrector/position_correction.hpp"

namespace panvo::fleet {
namespace {

constexpr std::size_t kMaxViews = 12;  // 40 kB each; older ones are dropped: their keypoints did not come

}  // namespace

Recognition::Recognition(const RecognitionParameters& parameters, const landmarks::KeypointParameters& keypoints,
                         const landmarks::PanoramaDescriber& describer, vision::StageObserver* observer)
    : parameters_(parameters), keypoint_parameters_(keypoints), describer_(describer), observer_(observer) {}

std::optional<std::string> Recognition::add(const cv::Mat& panorama, const ViewPoint& from,
                                            const std::vector<ForeignPlace>& places) {
  if (places.empty()) return std::nullopt;
  if (auto fault = landmarks::find_fault(panorama)) return fault;
  ++counts_.panoramas;
  const auto query = [&] {
    const vision::Stage stage(observer_, "describe");
    return describer_.query(panorama);
  }();
  View view;
  view.candidates = search(query, places);
  if (view.candidates.empty()) return std::nullopt;
  counts_.candidates += view.candidates.size();
  for (const auto& candidate : view.candidates) {
    if (kept_.contains(candidate.key)) continue;
    auto& wanted = wanted_[candidate.key];
    wanted.distance = std::min(wanted.distance, candidate.small);
  }
  view.from = from;
  {
    const vision::Stage stage(observer_, "keypoints");
    view.keypoints = detect_keypoints(panorama, keypoint_parameters_);
  }
  views_.push_back(std::move(view));
  if (views_.size() > kMaxViews) views_.pop_front();
  drop_unwanted();
  return std::nullopt;
}

std::vector<Recognition::Candidate> Recognition::search(const landmarks::QueryDescription& query,
                                                        const std::vector<ForeignPlace>& places) {
  std::vector<std::pair<Candidate, const landmarks::PanoramicLandmark*>> similar;
  {
    const vision::Stage stage(observer_, "compare");
    const auto count = std::min(places.size(), static_cast<std::size_t>(parameters_.max_compared));
    if (count == places.size()) next_ = 0;
    counts_.compared += count;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& place = places[(next_ + i) % places.size()];
      const auto& description = place.landmark->description;
      if (histogram_distance(query, description) > parameters_.max_histogram_distance) continue;
      const auto match = match_large_scale(query, description);
      if (match.distance > parameters_.max_large_distance) continue;
      similar.push_back({{place.key, match.heading_rad, match.distance, 1.0F}, place.landmark});
    }
    next_ += count;
  }
  const auto most = std::min(similar.size(), static_cast<std::size_t>(parameters_.max_verified));
  std::partial_sort(similar.begin(), similar.begin() + static_cast<std::ptrdiff_t>(most), similar.end(),
                    [](const auto& one, const auto& two) {
                      return std::tuple(one.first.large, one.first.key) < std::tuple(two.first.large, two.first.key);
                    });
  similar.resize(most);
  std::vector<Candidate> kept;
  for (auto& [candidate, landmark] : similar) {
    candidate.small = search_heading(query, landmark->description, candidate.heading_rad).distance;
    if (candidate.small <= parameters_.max_small_distance) kept.push_back(candidate);
  }
  return kept;
}

void Recognition::add(const PlaceKey& key, std::vector<landmarks::Keypoint> keypoints) {
  wanted_.erase(key);
  kept_[key] = {std::move(keypoints), ++uses_};
  if (kept_.size() <= static_cast<std::size_t>(parameters_.max_keypoint_sets)) return;
  kept_.erase(std::min_element(kept_.begin(), kept_.end(),
                               [](const auto& one, const auto& two) { return one.second.used < two.second.used; }));
}

void Recognition::forget(MapId map) {
  std::erase_if(kept_, [map](const auto& kept) { return kept.first.map == map; });
  std::erase_if(wanted_, [map](const auto& wanted) { return wanted.first.map == map; });
  for (auto& view : views_) {
    std::erase_if(view.candidates, [map](const auto& candidate) { return candidate.key.map == map; });
  }
  std::erase_if(views_, [](const auto& view) { return view.candidates.empty(); });
}

std::vector<Recognition::Ready> Recognition::take_ready() {
  std::vector<Ready> ready;
  for (auto& view : views_) {
    std::erase_if(view.candidates, [&](const Candidate& candidate) {
      if (!kept_.contains(candidate.key)) return false;
      ready.push_back({candidate.key, candidate.heading_rad, view.keypoints, view.from});
      return true;
    });
  }
  std::erase_if(views_, [](const auto& view) { return view.candidates.empty(); });
  return ready;
}

std::optional<Sighting> Recognition::verify(const Ready& ready, const landmarks::PanoramicLandmark& landmark) {
  const vision::Stage stage(observer_, "verify");
  auto& kept = kept_.at(ready.key);
  kept.used = ++uses_;
  ++counts_.verified;
  const auto found = estimate_panorama_pose(ready.keypoints, kept.keypoints, ready.heading_rad, parameters_.pose);
  if (!found.pose) return std::nullopt;
  ++counts_.recognised;
  const auto seen_from_base = to_base(*found.pose, {landmark.base_from_panorama, ready.from.base_from_panorama});
  Sighting sighting;
  sighting.own_place = ready.from.own_place;
  sighting.seen = ready.key;
  const Eigen::Isometry3d base_from_seen = seen_from_base.landmark_from_base.inverse();
  sighting.own_from_seen = ready.from.place_from_base * base_from_seen;
  sighting.covariance = vision::compose_covariance(
      ready.from.place_from_base, ready.from.covariance, base_from_seen,
      vision::invert_covariance(seen_from_base.landmark_from_base, seen_from_base.covariance));
  sighting.inliers = static_cast<std::uint32_t>(std::max(0, found.inliers));
  sighting.travelled_m = ready.from.travelled_m;
  return sighting;
}

std::optional<PlaceKey> Recognition::next_wanted(std::int64_t now_ns, std::size_t max_pending) {
  const auto retry_ns = static_cast<std::int64_t>(1e9 * parameters_.retry_s);
  const auto is_pending = [&](const Wanted& wanted) { return wanted.asked_ns && now_ns - *wanted.asked_ns < retry_ns; };
  const auto given_up = std::erase_if(wanted_, [&](const auto& entry) {
    return entry.second.tries >= parameters_.max_tries && !is_pending(entry.second);
  });
  counts_.given_up += given_up;
  std::size_t pending = 0;
  auto best = wanted_.end();
  for (auto entry = wanted_.begin(); entry != wanted_.end(); ++entry) {
    if (is_pending(entry->second)) {
      ++pending;
    } else if (best == wanted_.end() || entry->second.distance < best->second.distance) {
      best = entry;
    }
  }
  if (pending >= max_pending || best == wanted_.end()) return std::nullopt;
  best->second.asked_ns = now_ns;
  ++best->second.tries;
  return best->first;
}

/// What no waiting panorama needs any more is not asked for.
void Recognition::drop_unwanted() {
  std::erase_if(wanted_, [&](const auto& wanted) {
    return std::none_of(views_.begin(), views_.end(), [&](const View& view) {
      return std::any_of(view.candidates.begin(), view.candidates.end(),
                         [&](const Candidate& candidate) { return candidate.key == wanted.first; });
    });
  });
}

}  // namespace panvo::fleet

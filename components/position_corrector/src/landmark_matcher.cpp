// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/landmark_matcher.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "panvo/landmarks/heading_search.hpp"
#include "panvo/landmarks/landmark_distance.hpp"
#include "panvo/landmarks/panorama_check.hpp"

namespace panvo::position_corrector {
namespace {

constexpr double kSecond = 1e9;

template <class Candidates, class Keep>
int keep(Candidates& candidates, Keep is_kept) {
  std::erase_if(candidates, [&](const auto& candidate) { return !is_kept(candidate); });
  return static_cast<int>(candidates.size());
}

}  // namespace

LandmarkMatcher::LandmarkMatcher(const MatchingParameters& matching, const landmarks::KeypointParameters& keypoints,
                                 const landmarks::PanoramaDescriber& describer, vision::StageObserver* observer)
    : parameters_(matching), keypoint_parameters_(keypoints), describer_(describer), observer_(observer) {}

void LandmarkMatcher::added(std::uint32_t id) {
  if (has_started_) seen_at_m_[id] = travelled_m_;
}

LandmarkMatch LandmarkMatcher::match(const PanoramaFrame& frame, const landmarks::LandmarkLibrary& library) {
  has_started_ = true;
  travelled_m_ = frame.travelled_m;
  LandmarkMatch match;
  match.stamp_ns = frame.stamp_ns;
  if (const auto fault = landmarks::find_fault(frame.panorama)) {
    match.state = MatchState::kUnusable;
    match.reason = *fault;
    return match;
  }
  if (!lock_ && library.empty()) {
    match.reason = "no landmarks yet";
    return match;
  }
  const auto query = [&] {
    const vision::Stage stage(observer_, "describe");
    return describer_.query(frame.panorama);
  }();
  return lock_ ? follow(frame, query, library) : search(frame, query, library);
}

LandmarkMatch LandmarkMatcher::search(const PanoramaFrame& frame, const landmarks::QueryDescription& query,
                                      const landmarks::LandmarkLibrary& library) {
  LandmarkMatch match;
  match.stamp_ns = frame.stamp_ns;
  const auto ended = [&match](const char* reason) {
    match.reason = reason;
    return match;
  };
  auto near = candidates(frame, library);
  match.candidates = static_cast<int>(near.size());
  if (near.empty()) return ended("no landmark near the position");
  match.kept_after_histogram = keep_similar_histograms(query, near);
  if (near.empty()) return ended("no candidate has a similar histogram");
  match.kept_after_large = keep_similar_at_large_scale(query, near);
  if (near.empty()) return ended("no candidate is similar at the large scale");
  sort_by_small_scale(query, near);
  describe(near.front(), match);
  const auto is_similar = [&](const Candidate& candidate) {
    return candidate.small.distance <= parameters_.max_small_distance;
  };
  if (keep(near, is_similar) == 0) return ended("no candidate is similar at the small scale");
  verify(frame, library, near, match);
  return match;
}

int LandmarkMatcher::keep_similar_histograms(const landmarks::QueryDescription& query,
                                             std::vector<Candidate>& near) const {
  const vision::Stage stage(observer_, "histogram");
  for (auto& candidate : near) {
    candidate.histogram_distance = histogram_distance(query, candidate.landmark->description);
  }
  return keep(near, [&](const Candidate& candidate) {
    return candidate.histogram_distance <= parameters_.max_histogram_distance;
  });
}

int LandmarkMatcher::keep_similar_at_large_scale(const landmarks::QueryDescription& query,
                                                 std::vector<Candidate>& near) const {
  const vision::Stage stage(observer_, "large_scale");
  for (auto& candidate : near) candidate.large = match_large_scale(query, candidate.landmark->description);
  const int similar = keep(
      near, [&](const Candidate& candidate) { return candidate.large.distance <= parameters_.max_large_distance; });
  const auto most = std::min(near.size(), static_cast<std::size_t>(parameters_.max_verified));
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(most), near.end(),
                    [](const Candidate& a, const Candidate& b) {
                      return std::pair(a.large.distance, a.landmark->id) < std::pair(b.large.distance, b.landmark->id);
                    });
  near.resize(most);
  return similar;
}

void LandmarkMatcher::sort_by_small_scale(const landmarks::QueryDescription& query,
                                          std::vector<Candidate>& near) const {
  const vision::Stage stage(observer_, "small_scale");
  for (auto& candidate : near) {
    candidate.small = search_heading(query, candidate.landmark->description, candidate.large.heading_rad);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const Candidate& a, const Candidate& b) { return a.small.distance < b.small.distance; });
}

void LandmarkMatcher::describe(const Candidate& candidate, LandmarkMatch& match) {
  match.landmark_id = candidate.landmark->id;
  match.heading_rad = candidate.small.heading_rad;
  match.histogram_distance = candidate.histogram_distance;
  match.large_distance = candidate.large.distance;
  match.small_distance = candidate.small.distance;
}

void LandmarkMatcher::verify(const PanoramaFrame& frame, const landmarks::LandmarkLibrary& library,
                             const std::vector<Candidate>& near, LandmarkMatch& match) {
  auto keypoints = keypoints_of(frame.panorama);
  match.state = MatchState::kRejected;
  for (const auto& candidate : near) {
    const vision::Stage stage(observer_, "verify");
    auto found = estimate_panorama_pose(keypoints, library.keypoints(candidate.landmark->id),
                                        candidate.large.heading_rad, parameters_.pose);
    if (!found.pose) {
      if (!match.reason.empty()) continue;  // the first candidate is the most similar one
      match.reason = fmt::format("landmark {}: {}", candidate.landmark->id, found.reason);
      match.inliers = found.inliers;
      match.points = std::move(found.points);
      match.weak_pose = std::move(found.weak_pose);
      continue;
    }
    describe(candidate, match);
    match.weak_pose.reset();
    match.state = MatchState::kLocked;
    match.reason = fmt::format("{} of {} points agree", found.inliers, found.matches);
    match.inliers = found.inliers;
    match.points = std::move(found.points);
    match.heading_rad = found.pose->heading_rad;
    match.pose = std::move(found.pose);
    const double offset_m = match.pose->landmark_from_panorama.translation().norm();
    lock_ = Lock{match.landmark_id, match.heading_rad, match,          match.small_distance,
                 offset_m,          frame.travelled_m, frame.stamp_ns, {}};
    lock_->pass = {{{frame.travelled_m, match.small_distance}}, std::move(keypoints)};
    return;
  }
}

LandmarkMatch LandmarkMatcher::follow(const PanoramaFrame& frame, const landmarks::QueryDescription& query,
                                      const landmarks::LandmarkLibrary& library) {
  auto& lock = *lock_;
  LandmarkMatch match = lock.best;
  const auto* landmark = library.find(lock.landmark_id);
  if (landmark != nullptr) {
    match.stamp_ns = frame.stamp_ns;
    match.pose.reset();
    match.histogram_distance = histogram_distance(query, landmark->description);
    match.large_distance = match_large_scale(query, landmark->description).distance;
    {
      const vision::Stage stage(observer_, "small_scale");
      const auto small = search_heading(query, landmark->description, lock.heading_rad);
      match.small_distance = small.distance;
      match.heading_rad = small.heading_rad;
    }
    auto keypoints = keypoints_of(frame.panorama);
    const vision::Stage stage(observer_, "verify");
    auto found =
        estimate_panorama_pose(keypoints, library.keypoints(lock.landmark_id), match.heading_rad, parameters_.pose);
    match.reason = found.pose ? fmt::format("{} of {} points agree", found.inliers, found.matches) : found.reason;
    match.inliers = found.inliers;
    match.points = std::move(found.points);
    match.weak_pose = std::move(found.weak_pose);
    lock.pass.curve.push_back({frame.travelled_m, match.small_distance});
    // Far from the landmark the distance is flat and its noise has minima, but poses tell whether it is still ahead.
    const double offset_m = found.pose ? found.pose->landmark_from_panorama.translation().norm() : lock.nearest_m;
    if (found.pose) {
      match.heading_rad = lock.heading_rad = found.pose->heading_rad;
      match.pose = std::move(found.pose);
      if (match.small_distance < lock.best.small_distance) {
        lock.best = match;
        lock.pass.keypoints = std::move(keypoints);
      }
    }
    if (match.small_distance < lock.min_distance || offset_m < lock.nearest_m) {
      lock.min_distance = std::min(lock.min_distance, match.small_distance);
      lock.nearest_m = std::min(lock.nearest_m, offset_m);
      lock.min_at_m = frame.travelled_m;
      lock.min_at_ns = frame.stamp_ns;
    }
    const bool is_past = frame.travelled_m - lock.min_at_m > parameters_.window_m ||
                         static_cast<double>(frame.stamp_ns - lock.min_at_ns) > parameters_.window_s * kSecond;
    if (!is_past) return match;
  }
  match = lock.best;
  match.state = MatchState::kMatched;
  match.reason.clear();
  match.points.clear();
  match.pass = std::move(lock.pass);
  seen_at_m_[lock.landmark_id] = frame.travelled_m;
  lock_.reset();
  return match;
}

std::vector<LandmarkMatcher::Candidate> LandmarkMatcher::candidates(const PanoramaFrame& frame,
                                                                    const landmarks::LandmarkLibrary& library) const {
  std::vector<Candidate> found;
  const auto add = [&](const landmarks::PanoramicLandmark* landmark) {
    if (!is_left(landmark->id, frame.travelled_m)) return;
    found.emplace_back().landmark = landmark;
  };
  if (!frame.prior) {
    for (const auto* landmark : library.all()) add(landmark);
    return found;
  }
  const auto near =
      library.within(frame.prior->position, parameters_.radius_m + parameters_.radius_sigmas * frame.prior->sigma_m);
  for (const auto* landmark : near) add(landmark);
  return found;
}

bool LandmarkMatcher::is_left(std::uint32_t id, double travelled_m) const {
  const auto seen = seen_at_m_.find(id);
  return seen == seen_at_m_.end() || travelled_m - seen->second >= parameters_.leave_m;
}

std::vector<landmarks::Keypoint> LandmarkMatcher::keypoints_of(const cv::Mat& panorama) const {
  const vision::Stage stage(observer_, "keypoints");
  return detect_keypoints(panorama, keypoint_parameters_);
}

}  // namespace panvo::position_corrector

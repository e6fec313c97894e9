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
  // The stamps of a pass are of the time before; a landmark that is still here is found again.
  if (stamps_.add(frame.stamp_ns) == vision::StampOrder::kSetBack) lock_.reset();
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
  auto near = candidates(frame, query, library, match);
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
    candidate.histogram_distance = histogram_distance(query, candidate.description);
  }
  return keep(near, [&](const Candidate& candidate) {
    return candidate.histogram_distance <= parameters_.max_histogram_distance;
  });
}

int LandmarkMatcher::keep_similar_at_large_scale(const landmarks::QueryDescription& query,
                                                 std::vector<Candidate>& near) const {
  const vision::Stage stage(observer_, "large_scale");
  for (auto& candidate : near) candidate.large = match_large_scale(query, candidate.description);
  const int similar = keep(
      near, [&](const Candidate& candidate) { return candidate.large.distance <= parameters_.max_large_distance; });
  const auto most = std::min(near.size(), static_cast<std::size_t>(parameters_.max_verified));
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(most), near.end(),
                    [](const Candidate& a, const Candidate& b) {
                      return std::pair(a.large.distance, a.id) < std::pair(b.large.distance, b.id);
                    });
  near.resize(most);
  return similar;
}

void LandmarkMatcher::sort_by_small_scale(const landmarks::QueryDescription& query,
                                          std::vector<Candidate>& near) const {
  const vision::Stage stage(observer_, "small_scale");
  for (auto& candidate : near) {
    candidate.small = search_heading(query, candidate.description, candidate.large.heading_rad);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const Candidate& a, const Candidate& b) { return a.small.distance < b.small.distance; });
}

void LandmarkMatcher::describe(const Candidate& candidate, LandmarkMatch& match) {
  match.landmark_id = candidate.id;
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
    auto found = estimate_panorama_pose(keypoints, library.keypoints(candidate.id), candidate.large.heading_rad,
                                        parameters_.pose);
    if (!found.pose) {
      if (!match.reason.empty()) continue;  // the first candidate is the most similar one
      match.reason = fmt::format("landmark {}: {}", candidate.id, found.reason);
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
  if (library.find(lock.landmark_id) != nullptr) {
    match.stamp_ns = frame.stamp_ns;
    match.pose.reset();
    const auto description = library.description(lock.landmark_id);
    match.histogram_distance = histogram_distance(query, description);
    match.large_distance = match_large_scale(query, description).distance;
    {
      const vision::Stage stage(observer_, "small_scale");
      const auto small = search_heading(query, description, lock.heading_rad);
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
                                                                    const landmarks::QueryDescription& query,
                                                                    const landmarks::LandmarkLibrary& library,
                                                                    LandmarkMatch& match) const {
  const vision::Stage stage(observer_, "candidates");
  const std::set<std::uint32_t> here = not_left(frame.travelled_m);
  const auto is_asked = [&](std::uint32_t id) { return !here.contains(id); };
  const auto most = static_cast<std::size_t>(parameters_.max_compared);
  std::vector<std::uint32_t> ids;
  const auto take_most_similar = [&](const landmarks::LargeScaleIndex::Asked& asked) {
    const auto ranking = library.rank(query, most, asked);
    ids.clear();
    for (const auto& similar : ranking.nearest) ids.push_back(similar.id);
    std::ranges::sort(ids);
    return ranking.asked;
  };
  if (!frame.prior && library.size() > most) {
    match.candidates = static_cast<int>(take_most_similar(is_asked));
  } else {
    const auto radius_m = frame.prior ? parameters_.radius_m + parameters_.radius_sigmas * frame.prior->sigma_m
                                      : std::numeric_limits<double>::infinity();
    const auto near = library.within(frame.prior ? frame.prior->position : Eigen::Vector3d::Zero(), radius_m);
    for (const auto* landmark : near) {
      if (is_asked(landmark->id)) ids.push_back(landmark->id);
    }
    match.candidates = static_cast<int>(ids.size());
    if (ids.size() > most) {
      take_most_similar([near_ids = ids](std::uint32_t id) { return std::ranges::binary_search(near_ids, id); });
    }
  }
  std::vector<Candidate> found;
  for (const auto id : ids) {
    auto& candidate = found.emplace_back();
    candidate.id = id;
    candidate.description = library.description(id);
  }
  return found;
}

std::set<std::uint32_t> LandmarkMatcher::not_left(double travelled_m) const {
  std::set<std::uint32_t> ids;
  for (const auto& [id, seen_at_m] : seen_at_m_) {
    if (travelled_m - seen_at_m < parameters_.leave_m) ids.insert(id);
  }
  return ids;
}

std::vector<landmarks::Keypoint> LandmarkMatcher::keypoints_of(const cv::Mat& panorama) const {
  const vision::Stage stage(observer_, "keypoints");
  return detect_keypoints(panorama, keypoint_parameters_, seen_);
}

}  // namespace panvo::position_corrector

// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/junction_filter.hpp"

#include <algorithm>

namespace panvo::landmark_builder {
namespace {

constexpr double kFilteredPath_m = 60.0;
constexpr double kOutOfSight_m = 25.0;
constexpr double kStandingStep_m = 0.01;
constexpr std::size_t kMaxPlaces = 2000;  // limit while the vehicle stands still

}  // namespace

std::vector<PassedJunction> JunctionFilter::add(std::int64_t stamp_ns, const Eigen::Vector2d& position_in_odom,
                                                const std::optional<SeenJunction>& seen) {
  const double step_m = path_.empty() ? 0.0 : (position_in_odom - path_.back().position).norm();
  const double travelled_m = path_.empty() ? 0.0 : path_.back().travelled_m + step_m;
  path_.push_back({stamp_ns, position_in_odom, travelled_m});
  while (path_.size() > kMaxPlaces || travelled_m - path_.front().travelled_m > kFilteredPath_m) path_.pop_front();

  Candidate* shown = nullptr;
  if (seen) {
    double best_m = parameters_.merge_radius_m;
    for (Candidate& candidate : candidates_) {
      const double distance_m = (candidate.centre() - seen->centre_in_odom).norm();
      if (distance_m >= best_m) continue;
      best_m = distance_m;
      shown = &candidate;
    }
    if (shown == nullptr) {
      shown = &candidates_.emplace_back();
      shown->first_m = travelled_m;
    }
    const double weight = std::max(step_m, kStandingStep_m);  // a stationary vehicle gains no information
    shown->sum += weight * seen->centre_in_odom;
    shown->weight += weight;
    ++shown->seen;
    shown->last_m = travelled_m;
  }
  std::vector<PassedJunction> passed;
  for (auto candidate = candidates_.begin(); candidate != candidates_.end();) {
    const double now_m = (position_in_odom - candidate->centre()).norm();
    const double closest_m = (nearest(candidate->centre()).position - candidate->centre()).norm();
    const bool is_behind = now_m - closest_m >= parameters_.passed_m;
    const bool is_over = travelled_m - candidate->last_m >= parameters_.max_gap_m || now_m > kOutOfSight_m;
    if (!candidate->is_passed && is_behind && is_over) {
      if (const auto junction = conclude(*candidate)) {
        passed.push_back(*junction);
        candidate->is_passed = true;
      }
    }
    candidate = now_m > kOutOfSight_m && now_m > closest_m + parameters_.passed_m ? candidates_.erase(candidate)
                                                                                  : std::next(candidate);
  }
  return passed;
}

bool JunctionFilter::is_pending() const {
  return std::any_of(candidates_.begin(), candidates_.end(),
                     [](const auto& candidate) { return !candidate.is_passed; });
}

/// Of several equally near places the first. An earlier visit ended where the junction was out of sight.
const JunctionFilter::Place& JunctionFilter::nearest(const Eigen::Vector2d& centre) const {
  const Place* best = &path_.back();
  double best_m2 = (best->position - centre).squaredNorm();
  bool was_in_sight = false;
  for (auto place = path_.rbegin(); place != path_.rend(); ++place) {
    const double distance_m2 = (place->position - centre).squaredNorm();
    const bool is_in_sight = distance_m2 <= kOutOfSight_m * kOutOfSight_m;
    if (was_in_sight && !is_in_sight) break;
    was_in_sight = is_in_sight;
    if (distance_m2 > best_m2) continue;
    best_m2 = distance_m2;
    best = &*place;
  }
  return *best;
}

std::optional<PassedJunction> JunctionFilter::conclude(const Candidate& candidate) const {
  if (candidate.last_m - candidate.first_m < parameters_.min_seen_m) return std::nullopt;
  const Place& closest = nearest(candidate.centre());
  const double nearest_m = (closest.position - candidate.centre()).norm();
  if (nearest_m > parameters_.max_pass_distance_m) return std::nullopt;
  const auto along = std::count_if(path_.begin(), path_.end(), [&](const Place& place) {
    return place.travelled_m >= candidate.first_m && place.travelled_m <= candidate.last_m;
  });
  if (candidate.seen < parameters_.min_share * static_cast<double>(along)) return std::nullopt;
  return PassedJunction{candidate.centre(), closest.stamp_ns, nearest_m, candidate.seen};
}

}  // namespace panvo::landmark_builder

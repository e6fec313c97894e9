// SPDX-License-Identifier: Apache-2.0
#include "run_finder.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace panvo::landmarks {
namespace {

/// Whether the store has another id than the run for one of its landmarks.
bool has_own_ids(const StoredRun& run) {
  return std::ranges::any_of(run.ids, [](const auto& ids) { return ids.first != ids.second; });
}

/// The component that stored the run's landmarks, with its namespace.
std::string component_of(const StoredRun& run) { return run.id.substr(std::min(run.id.find('/'), run.id.size())); }

}  // namespace

void keep_of_component(std::vector<StoredRun>& runs, const StoredRun& own) {
  std::erase_if(runs, [&](const StoredRun& run) { return component_of(run) != component_of(own); });
}

std::optional<RunFinder> RunFinder::among(std::vector<StoredRun> runs, const LandmarkStore& store) {
  if (!std::ranges::any_of(runs, has_own_ids)) return std::nullopt;
  RunFinder finder(std::move(runs), store.landmarks());
  if (!finder.is_needed()) return std::nullopt;
  return finder;
}

RunFinder::RunFinder(std::vector<StoredRun> runs, const std::vector<PanoramicLandmark>& stored)
    : runs_(std::move(runs)) {
  for (const auto& landmark : stored) {
    const Eigen::Vector3d position = landmark.map_from_base.translation();
    stored_[landmark.id] = {landmark.stamp_ns, landmark.description.histogram, position.head<2>()};
  }
}

bool RunFinder::is_needed() const {
  return std::ranges::any_of(runs_, [this](const StoredRun& run) {
    return std::ranges::any_of(
        run.ids, [this](const auto& ids) { return ids.first != ids.second && stored_.contains(ids.second); });
  });
}

bool RunFinder::hear(const PanoramicLandmark& landmark) {
  const bool was_said = said_.has_value();
  std::erase_if(runs_, [&](const StoredRun& run) {
    const auto id = run.ids.find(landmark.id);
    const auto stored = id == run.ids.end() ? stored_.end() : stored_.find(id->second);
    if (stored == stored_.end()) return false;
    const bool is_same =
        stored->second.stamp_ns == landmark.stamp_ns && stored->second.histogram == landmark.description.histogram;
    if (is_same) said_ = run;
    return !is_same;
  });
  return !was_said && said_;
}

void RunFinder::hear(const std::vector<LandmarkPose>& poses) {
  for (const auto& pose : poses) poses_.insert_or_assign(pose.id, pose);
}

std::optional<StoredRun> RunFinder::found() const {
  if (said_) return said_;
  const StoredRun* best = nullptr;
  int most = 0;
  for (const auto& run : runs_) {
    const int votes = votes_for(run);
    if (votes < most || votes == 0) continue;
    best = votes > most ? &run : nullptr;  // two that fit equally well: none
    most = votes;
  }
  return best == nullptr ? std::nullopt : std::optional(*best);
}

bool RunFinder::is_near(std::uint32_t stored_id, const LandmarkPose& pose) const {
  const auto stored = stored_.find(stored_id);
  if (stored == stored_.end()) return false;
  const Eigen::Vector3d position = pose.map_from_base.translation();
  return (position.head<2>() - stored->second.position).norm() < kSamePlace_m;
}

/// Poses at the place that the run has for their ids, without those at the place that the store has for them.
int RunFinder::votes_for(const StoredRun& run) const {
  int votes = 0;
  for (const auto& [id, pose] : poses_) {
    const auto own = run.ids.find(id);
    if (own == run.ids.end() || own->second == id) continue;
    votes += (is_near(own->second, pose) ? 1 : 0) - (is_near(id, pose) ? 1 : 0);
  }
  return std::max(votes, 0);
}

}  // namespace panvo::landmarks

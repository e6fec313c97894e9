// SPDX-License-Identifier: Apache-2.0
#include "store_changes.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace panvo::landmarks {
namespace {

void make(const BegunRun& change, LandmarkStore& store, StoredIds&) { store.begin_run(change.run); }

void make(const NewLandmark& change, LandmarkStore& store, StoredIds& ids) {
  store.require(change.settings);
  const bool may_be_taken = change.landmark.id <= ids.last_known;
  const auto id = store.add(change.landmark, may_be_taken ? IfTaken::kNextId : IfTaken::kRefuse, change.use);
  ids.last_known = std::max(ids.last_known, id);
  ids.known.insert_or_assign(change.landmark.id, id);
}

void make(const MovedLandmarks& change, LandmarkStore& store, StoredIds& ids) {
  auto poses = change.poses;
  for (auto& pose : poses) pose.id = ids.of(pose.id);
  store.set_poses(poses);
}

void make(const RemovedLandmark& change, LandmarkStore& store, StoredIds& ids) {
  const auto id = ids.of(change.id);
  store.remove(std::span(&id, 1));
  ids.forget(change.id);
}

void make(const PassedLandmarks& change, LandmarkStore& store, StoredIds& ids) {
  auto passes = change.passes;
  for (auto& pass : passes) pass.id = ids.of(pass.id);
  store.count(passes);
}

std::size_t weight_of(const StoreChange& change) {
  if (const auto* passed = std::get_if<PassedLandmarks>(&change)) return passed->passes.size();
  const bool is_for_free = std::holds_alternative<MovedLandmarks>(change) || std::holds_alternative<BegunRun>(change);
  return is_for_free ? 0 : 1;
}

}  // namespace

std::uint32_t StoredIds::of(std::uint32_t id) const {
  const auto found = known.find(id);
  return found == known.end() ? id : found->second;
}

void apply(const StoreChange& change, LandmarkStore& store, StoredIds& ids) {
  std::visit([&](const auto& its) { make(its, store, ids); }, change);
}

bool PendingChanges::push(StoreChange change) {
  const auto weight = weight_of(change);
  if (weight_ > 0 && weight_ + weight > most_) {  // one that waits alone has room, however many passes it is
    refused_ += weight;
    return false;
  }
  weight_ += weight;
  if (auto* moved = std::get_if<MovedLandmarks>(&change)) {
    push_poses(std::move(*moved));
    return true;
  }
  auto* passed = std::get_if<PassedLandmarks>(&change);
  auto* last = waiting_.empty() || !passed ? nullptr : std::get_if<PassedLandmarks>(waiting_.back().get());
  if (last) {
    last->passes.insert(last->passes.end(), passed->passes.begin(), passed->passes.end());
  } else {
    waiting_.push_back(std::make_shared<StoreChange>(std::move(change)));
  }
  return true;
}

void PendingChanges::push_poses(MovedLandmarks moved) {
  std::map<std::uint32_t, LandmarkPose> latest;
  std::erase_if(waiting_, [&](const auto& change) {
    const auto* earlier = std::get_if<MovedLandmarks>(change.get());
    if (!earlier) return false;
    for (const auto& pose : earlier->poses) latest.insert_or_assign(pose.id, pose);
    return true;
  });
  for (const auto& pose : moved.poses) latest.insert_or_assign(pose.id, pose);
  moved.poses.clear();
  for (const auto& [id, pose] : latest) moved.poses.push_back(pose);
  waiting_.push_back(std::make_shared<StoreChange>(std::move(moved)));  // after the landmarks that it moves
}

std::size_t PendingChanges::size() const {
  const auto counts = [](const auto& change) { return change && !std::holds_alternative<BegunRun>(*change); };
  return static_cast<std::size_t>(std::ranges::count_if(waiting_, counts)) + (counts(current_) ? 1 : 0);
}

std::shared_ptr<const StoreChange> PendingChanges::take() {
  if (waiting_.empty()) return nullptr;
  current_ = waiting_.front();
  weight_ -= weight_of(*current_);
  waiting_.pop_front();
  return current_;
}

}  // namespace panvo::landmarks

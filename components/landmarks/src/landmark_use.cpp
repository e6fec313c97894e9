// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_use.hpp"

#include <algorithm>

namespace panvo::landmarks {
namespace {

double share_recognised(const std::deque<bool>& passes) {
  return static_cast<double>(std::count(passes.begin(), passes.end(), true)) / static_cast<double>(passes.size());
}

}  // namespace

void add(const LandmarkPass& pass, LandmarkUse& use) {
  ++use.passes;
  if (pass.recognised) {
    ++use.recognitions;
    use.missed = use.missed_in_company = 0;
    return;
  }
  ++use.missed;
  if (pass.in_company) ++use.missed_in_company;
}

void PassCounter::set_landmark(std::uint32_t id, const Eigen::Vector2d& position_m, std::uint32_t session) {
  const auto [found, is_new] = landmarks_.try_emplace(id);
  auto& landmark = found->second;
  if (is_new) landmark.is_just_built = last_ && (position_m - *last_).norm() <= kLeft_m;
  landmark.position = position_m;
  landmark.session = session;
}

void PassCounter::recognised(std::uint32_t id) {
  if (const auto found = landmarks_.find(id); found != landmarks_.end()) found->second.is_recognised = true;
}

void PassCounter::leave_out_current() {
  for (auto& [id, landmark] : landmarks_) landmark.is_just_built = true;  // until the vehicle is not near it
}

std::vector<LandmarkPass> PassCounter::move_to(const Eigen::Vector2d& position_m) {
  std::vector<LandmarkPass> ended;
  if (last_ && (position_m - *last_).norm() < kStep_m) return ended;
  last_ = position_m;
  for (auto& [id, landmark] : landmarks_) {
    const double distance_m = (landmark.position - position_m).norm();
    if (distance_m <= kPassed_m) landmark.is_passed = true;
    if (distance_m <= kLeft_m) continue;
    // Recognised from farther away than a pass: that counts, as it could as well have been missed.
    if (!landmark.is_just_built && (landmark.is_passed || landmark.is_recognised)) {
      ended.push_back({id, landmark.is_recognised, looks_same(landmark.session)});
      auto& recent = recent_[landmark.session];
      recent.push_back(landmark.is_recognised);
      if (recent.size() > kRecent) recent.pop_front();
    }
    landmark.is_passed = landmark.is_recognised = landmark.is_just_built = false;
  }
  return ended;
}

bool PassCounter::looks_same(std::uint32_t session) const {
  const auto passes = recent_.find(session);
  return passes != recent_.end() && passes->second.size() >= kEnoughSame && share_recognised(passes->second) >= kMost;
}

bool PassCounter::looks_different(std::uint32_t session) const {
  const auto passes = recent_.find(session);
  return passes != recent_.end() && passes->second.size() >= kEnoughOther && share_recognised(passes->second) <= kFew;
}

UseRules::Admission UseRules::admit(const std::vector<Neighbour>& neighbours) const {
  const auto is_missed = [&](const Neighbour& neighbour) {
    return static_cast<int>(neighbour.use.missed) + 1 >= (neighbour.looks_different ? learn_after : learn_after_alone);
  };
  if (!std::all_of(neighbours.begin(), neighbours.end(), is_missed)) return {};
  if (neighbours.empty() || static_cast<int>(neighbours.size()) < appearances) return {true, std::nullopt};
  if (forget_after <= 0 || appearances <= 1) return {};
  const auto outdated =
      std::max_element(neighbours.begin(), neighbours.end(),
                       [](const Neighbour& one, const Neighbour& other) { return one.use.missed < other.use.missed; });
  if (outdated->use.missed < static_cast<std::uint32_t>(forget_after)) return {};
  return {true, static_cast<std::size_t>(outdated - neighbours.begin())};
}

bool UseRules::forgets(const LandmarkUse& use) const {
  return forget_after > 0 && use.missed_in_company >= static_cast<std::uint32_t>(forget_after);
}

}  // namespace panvo::landmarks

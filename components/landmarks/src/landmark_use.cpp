// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_use.hpp"

#include <algorithm>
#include <cstdlib>

namespace panvo::landmarks {

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

void PassCounter::set_landmark(std::uint32_t id, const Eigen::Vector2d& position_m, std::int64_t stamp_ns) {
  auto& landmark = landmarks_[id];
  landmark.position = position_m;
  landmark.stamp_ns = stamp_ns;
}

void PassCounter::recognised(std::uint32_t id) {
  const auto found = landmarks_.find(id);
  if (found == landmarks_.end()) return;
  found->second.is_recognised = true;
  std::erase_if(recent_, [id](const Recognition& other) { return other.id == id; });
  recent_.push_back({id, found->second.stamp_ns, travelled_m_});
}

std::vector<LandmarkPass> PassCounter::move_to(const Eigen::Vector2d& position_m) {
  std::vector<LandmarkPass> ended;
  if (last_ && (position_m - *last_).norm() < kStep_m) return ended;
  if (last_) travelled_m_ += (position_m - *last_).norm();
  last_ = position_m;
  while (!recent_.empty() && travelled_m_ - recent_.front().travelled_m > kCompany_m) recent_.pop_front();
  for (auto& [id, landmark] : landmarks_) {
    const double distance_m = (landmark.position - position_m).norm();
    if (distance_m <= kPassed_m) landmark.is_passed = true;
    if (distance_m <= kLeft_m) continue;
    // Recognised from farther away than a pass: that counts, as it could as well have been missed.
    if (landmark.is_passed || landmark.is_recognised) {
      ended.push_back({id, landmark.is_recognised, has_company(id, landmark.stamp_ns)});
    }
    landmark.is_passed = landmark.is_recognised = false;
  }
  return ended;
}

bool PassCounter::has_company(std::uint32_t id, std::int64_t stamp_ns) const {
  return std::any_of(recent_.begin(), recent_.end(), [&](const Recognition& other) {
    return other.id != id && std::abs(other.stamp_ns - stamp_ns) < kDay_ns;
  });
}

UseRules::Admission UseRules::admit(const std::vector<LandmarkUse>& beside) const {
  const bool all_missed =
      std::all_of(beside.begin(), beside.end(), [](const LandmarkUse& use) { return use.missed > 0; });
  if (!all_missed) return {};
  if (beside.empty() || static_cast<int>(beside.size()) < appearances) return {true, std::nullopt};
  if (forget_after <= 0 || appearances <= 1) return {};
  const auto outdated =
      std::max_element(beside.begin(), beside.end(),
                       [](const LandmarkUse& one, const LandmarkUse& other) { return one.missed < other.missed; });
  if (outdated->missed < static_cast<std::uint32_t>(forget_after)) return {};
  return {true, static_cast<std::size_t>(outdated - beside.begin())};
}

bool UseRules::forgets(const LandmarkUse& use) const {
  return forget_after > 0 && use.missed_in_company >= static_cast<std::uint32_t>(forget_after);
}

}  // namespace panvo::landmarks

// SPDX-License-Identifier: Apache-2.0
#include "map_use.hpp"

namespace panvo::landmarks {

void MapUse::add(const LandmarkPose& pose, const LandmarkUse& use, const std::optional<LandmarkUse>& before) {
  landmarks_[pose.id] = {Eigen::Vector2d::Zero(), use, before};
  move(pose);
}

void MapUse::move(const LandmarkPose& pose) {
  const auto found = landmarks_.find(pose.id);
  if (found == landmarks_.end()) return;
  found->second.position = pose.map_from_base.translation().head<2>();
  passes_.set_landmark(pose.id, found->second.position, found->second.use.session);
}

void MapUse::forget(std::uint32_t id) { landmarks_.erase(id); }

std::vector<LandmarkPass> MapUse::drive_to(const Eigen::Vector2d& position_m) {
  auto passes = passes_.move_to(position_m);
  for (const auto& pass : passes) {
    if (const auto found = landmarks_.find(pass.id); found != landmarks_.end()) landmarks::add(pass, found->second.use);
  }
  return passes;
}

std::vector<std::uint32_t> MapUse::outdated(const std::map<std::uint32_t, LandmarkUse>& uses) const {
  std::vector<std::uint32_t> ids;
  for (const auto& [id, use] : uses) {
    if (rules_.forgets(use)) ids.push_back(id);
  }
  return ids;
}

MapUse::Admission MapUse::admit(const Eigen::Vector2d& position_m) const {
  std::vector<std::uint32_t> ids;
  std::vector<UseRules::Neighbour> neighbours;
  for (const auto& [id, landmark] : landmarks_) {
    if (!landmark.before || (landmark.position - position_m).norm() > rules_.same_place_m) continue;
    ids.push_back(id);
    neighbours.push_back({*landmark.before, passes_.looks_different(landmark.before->session)});
  }
  const auto admission = rules_.admit(neighbours);
  Admission named{admission.is_kept, {}, {}};
  if (admission.instead_of) named.instead_of = ids[*admission.instead_of];
  if (!ids.empty()) named.beside = ids.front();
  return named;
}

}  // namespace panvo::landmarks

// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/id_disputes.hpp"

namespace panvo::landmarks {

std::optional<LandmarkPose> IdDisputes::begin(const LandmarkPose& other) {
  const auto known = kept_.find(other.id);
  if (known == kept_.end() || known->second.other) return std::nullopt;
  auto& places = known->second;
  places.other = other.map_from_base.translation();
  const Eigen::Vector3d now = places.now.map_from_base.translation();
  const Eigen::Vector3d first = places.first.map_from_base.translation();
  if ((now - first).norm() <= (now - *places.other).norm()) return std::nullopt;
  places.other = now;
  places.now = places.first;
  return places.now;
}

bool IdDisputes::is_disputed(std::uint32_t id) const {
  const auto known = kept_.find(id);
  return known != kept_.end() && known->second.other;
}

bool IdDisputes::move(const LandmarkPose& pose) {
  const auto known = kept_.find(pose.id);
  if (known == kept_.end()) return true;
  auto& places = known->second;
  const Eigen::Vector3d there = pose.map_from_base.translation();
  const bool is_of_other =
      places.other && (there - *places.other).norm() < (there - places.now.map_from_base.translation()).norm();
  if (is_of_other) {
    places.other = there;
  } else {
    places.now = pose;
  }
  return !is_of_other;
}

}  // namespace panvo::landmarks

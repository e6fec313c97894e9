// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/map_replica.hpp"

#include <algorithm>
#include <iterator>

namespace panvo::landmarks {

bool MapReplica::is_other(const PanoramicLandmark& landmark) const {
  const auto known = places_.find(landmark.id);
  return known != places_.end() && known->second.stamp_ns && *known->second.stamp_ns != landmark.stamp_ns;
}

bool MapReplica::add(PanoramicLandmark& landmark) {
  const bool is_new = !owned_.contains(landmark.id) && set({landmark.id, landmark.map_from_base, landmark.covariance});
  auto& place = places_.at(landmark.id);
  place.stamp_ns = landmark.stamp_ns;
  landmark.map_from_base = place.pose.map_from_base;
  landmark.covariance = place.pose.covariance;
  return is_new;
}

std::vector<LandmarkPose> MapReplica::move(const std::vector<LandmarkPose>& poses) {
  std::vector<LandmarkPose> moved;
  std::copy_if(poses.begin(), poses.end(), std::back_inserter(moved),
               [this](const LandmarkPose& pose) { return set(pose); });
  owned_.clear();
  for (const auto& pose : poses) owned_.insert(pose.id);
  // A landmark that never came and that the owner no longer knows: otherwise such poses would pile up.
  std::erase_if(places_, [this](const auto& place) { return !place.second.stamp_ns && !owned_.contains(place.first); });
  return moved;
}

/// Returns whether this changed anything.
bool MapReplica::set(const LandmarkPose& pose) {
  constexpr double kRounding = 1e-9;  // of rotations as quaternions: a pose that was published may come back
  const auto [known, is_new] = places_.try_emplace(pose.id, Place{pose, {}});
  if (is_new) return true;
  const auto& before = known->second.pose;
  const double apart = (before.map_from_base.matrix() - pose.map_from_base.matrix()).cwiseAbs().maxCoeff();
  if (apart <= kRounding && before.covariance == pose.covariance) return false;
  known->second.pose = pose;
  return true;
}

}  // namespace panvo::landmarks

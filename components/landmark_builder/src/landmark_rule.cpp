// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/landmark_rule.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::landmark_builder {

void LandmarkRule::recognised(double travelled_m) {
  recognised_m_ = travelled_m;
  last_m_ = std::max(last_m_, travelled_m);
}

bool LandmarkRule::takes(const landmarks::MapReplica& map, const Eigen::Vector2d& position,
                         double place_travelled_m) const {
  if (recognised_m_ && std::abs(place_travelled_m - *recognised_m_) <= parameters_.known_m) return false;
  int nearby = 0;
  for (const auto& [id, place] : map.places()) {
    if ((place.pose.map_from_base.translation().head<2>() - position).norm() > parameters_.nearby_m) continue;
    if (!(place.stamp_ns && begin_ns_ && *place.stamp_ns < *begin_ns_)) return false;
    ++nearby;
  }
  if (nearby == 0) return true;
  return nearby < parameters_.appearances && recognised_m_ &&
         place_travelled_m - *recognised_m_ <= parameters_.trusted_m;
}

bool LandmarkRule::is_due(const landmarks::MapReplica& map, double travelled_m) const {
  if (parameters_.max_spacing_m <= 0.0) return false;
  return travelled_m - last_m_ >= (map.places().empty() ? parameters_.first_m : parameters_.max_spacing_m);
}

}  // namespace panvo::landmark_builder

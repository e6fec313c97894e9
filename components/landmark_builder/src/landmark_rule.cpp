// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/landmark_rule.hpp"

#include <algorithm>
#include <cmath>

namespace panvo::landmark_builder {

void LandmarkRule::set_landmark(std::uint32_t id, const Eigen::Vector2d& position) { positions_[id] = position; }

void LandmarkRule::recognised(double travelled_m) {
  recognised_m_ = travelled_m;
  last_m_ = std::max(last_m_, travelled_m);
}

bool LandmarkRule::takes(const Eigen::Vector2d& position, double place_travelled_m) const {
  if (recognised_m_ && std::abs(place_travelled_m - *recognised_m_) <= parameters_.known_m) return false;
  int nearby = 0;
  for (const auto& [id, where] : positions_) {
    if ((where - position).norm() > parameters_.nearby_m) continue;
    if (!earlier_.contains(id)) return false;
    ++nearby;
  }
  if (nearby == 0) return true;
  return nearby < parameters_.appearances && recognised_m_ &&
         place_travelled_m - *recognised_m_ <= parameters_.trusted_m;
}

bool LandmarkRule::is_due(double travelled_m) const {
  if (parameters_.max_spacing_m <= 0.0) return false;
  return travelled_m - last_m_ >= (positions_.empty() ? parameters_.first_m : parameters_.max_spacing_m);
}

}  // namespace panvo::landmark_builder

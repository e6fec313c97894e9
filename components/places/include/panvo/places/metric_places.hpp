// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "panvo/places/place_library.hpp"

namespace panvo::places {

/// A position in metres, in the frame of the poses that the library was built with.
struct MetricPosition {
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  double sigma_m = 0.0;  ///< horizontal, along the worst direction
};

/// Gives keypoints points in metres: those of a place with a pose that other places with poses, half a metre to 6 m away, see
/// as well. Returns the number of places that have enough of them for a position.
int triangulate_places(std::vector<KnownPlace>& places);

/// Position of the vehicle by the points of a place; nullopt without a pose, or if too few points agree. `heading_rad`: yaw at
/// the query minus yaw at the place.
std::optional<MetricPosition> metric_position(std::span<const landmarks::Keypoint> query, const KnownPlace& place,
                                              double heading_rad);

}  // namespace panvo::places

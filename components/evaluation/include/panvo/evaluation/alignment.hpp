// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string_view>

#include "panvo/evaluation/association.hpp"

namespace panvo::evaluation {

enum class Alignment {
  kNone,   // the estimate is already in the frame of the ground truth
  kStart,  // the first poses coincide, as for a vehicle with a known start
  kSe3,    // least squares over all positions: rotation and translation
  kSim3,   // least squares over all positions: rotation, translation and scale
};

std::string_view to_string(Alignment alignment);

// map_point = scale * R * odom_point + t
struct MapFromOdom {
  double scale = 1.0;
  Eigen::Isometry3d rigid = Eigen::Isometry3d::Identity();

  Eigen::Isometry3d operator*(const Eigen::Isometry3d& odom_from_base) const;
};

// Closed-form least squares [Umeyama1991]. nullopt if the positions do not determine it: no pairs, or one of the paths
// does not move. On a straight path, roll about the path is undetermined: positions are aligned, but orientations are
// meaningless.
std::optional<MapFromOdom> align(std::span<const PosePair> pairs, Alignment alignment);

}  // namespace panvo::evaluation

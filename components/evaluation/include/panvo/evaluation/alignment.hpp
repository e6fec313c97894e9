// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string_view>

#include "panvo/evaluation/association.hpp"

namespace panvo::evaluation {

enum class Alignment {
  kNone,   // the estimate is taken to be in the ground truth's frame
  kStart,  // the first pose of the estimate is laid on that of the ground truth: what a vehicle would see
  kSe3,    // least squares over all positions, rotation and translation
  kSim3,   // the same, with scale
};

std::string_view to_string(Alignment alignment);

// map_point = scale * R * odom_point + t
struct MapFromOdom {
  double scale = 1.0;
  Eigen::Isometry3d rigid = Eigen::Isometry3d::Identity();

  Eigen::Isometry3d operator*(const Eigen::Isometry3d& odom_from_base) const;
};

// The closed form of least squares [Umeyama1991]. nullopt where the positions do not determine it: no pairs, or
// either path stays in one place. Along a straight line the roll about the line is free: positions are then still
// aligned, orientations are not meaningful.
std::optional<MapFromOdom> align(std::span<const PosePair> pairs, Alignment alignment);

}  // namespace panvo::evaluation

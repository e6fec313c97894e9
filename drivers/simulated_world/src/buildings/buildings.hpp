// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "facade.hpp"

namespace panvo::simulated_world {

/// A building's body: a box with four facades and a roof. x to the right along the front as seen from the road, y
/// towards the back, z up from the ground floor; the origin is the centre of the box.
struct Body {
  Eigen::Isometry3f world_from_body = Eigen::Isometry3f::Identity();
  float width = 12.0f, depth = 10.0f;  ///< m, along x and y
  float depth_below = 0.5f;            ///< m; depth of its walls below the floor
  bool ridge_across = false;           ///< the gable faces the front

  /// The four walls: front, right, back, left.
  WallFrame wall(int side) const;
};

void build_body(const FacadeStyle& style, const BuildingMaterials& materials, const Body& body, Random lights,
                Mesh& mesh);

/// Adds the roof with chimneys, dormers and gutters, or the structures on a flat roof (buildings_roof.cpp).
void build_roof(const FacadeStyle& style, const BuildingMaterials& materials, const Body& body, Random random,
                Mesh& mesh);

}  // namespace panvo::simulated_world

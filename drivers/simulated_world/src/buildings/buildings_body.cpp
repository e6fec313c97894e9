// SPDX-License-Identifier: Apache-2.0
#include "buildings_body.hpp"

namespace panvo::simulated_world {

WallFrame Body::wall(int side) const {
  const Eigen::Vector3f x = world_from_body.linear().col(0), y = world_from_body.linear().col(1);
  const Eigen::Vector3f outwards[] = {-y, x, y, -x};
  const Eigen::Vector3f right[] = {x, y, -x, -y};
  const bool is_along = side % 2 == 0;
  WallFrame frame;
  frame.outwards = outwards[side];
  frame.right = right[side];
  frame.width = is_along ? width : depth;
  frame.depth_below = depth_below;
  frame.origin = world_from_body.translation() + 0.5f * (is_along ? depth : width) * frame.outwards -
                 0.5f * frame.width * frame.right;
  return frame;
}

void build_body(const FacadeStyle& style, const BuildingMaterials& materials, const Body& body, Random lights,
                Mesh& mesh) {
  constexpr FacadeSide kSides[] = {FacadeSide::kFront, FacadeSide::kSide, FacadeSide::kBack, FacadeSide::kSide};
  for (int side = 0; side < 4; ++side) {
    build_facade(style, materials, body.wall(side), kSides[side], lights.part(static_cast<std::uint64_t>(side)), mesh);
  }
  build_roof(style, materials, body, lights.part(9), mesh);
}

}  // namespace panvo::simulated_world

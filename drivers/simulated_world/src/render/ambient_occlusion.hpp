// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "embree.hpp"
#include "panvo/simulated_world/mesh.hpp"

namespace panvo::simulated_world {

/// The ambient light that reaches each vertex of a mesh in `scene` (ambient occlusion [Zhukov et al. 1998]): 0..255.
/// Near occluders count more than those at `reach_m`. Vertices inside solid objects, whose triangles may extend
/// outside, count as half open.
std::vector<std::uint8_t> ambient_light(RTCScene scene, const Mesh& mesh, float reach_m = 6.0f);

}  // namespace panvo::simulated_world

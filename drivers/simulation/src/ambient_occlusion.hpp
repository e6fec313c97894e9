// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <vector>

#include "panvo/simulation/mesh.hpp"

namespace panvo::simulation {

/// How much of the light from all round reaches each vertex of a mesh that stands in `scene` (ambient occlusion
/// [Zhukov et al. 1998]): 0..255. What is near shuts out more than what is `reach_m` away.
/// Vertices inside of something solid, which nobody sees but whose triangles reach out of it, count as half open.
std::vector<std::uint8_t> ambient_light(RTCScene scene, const Mesh& mesh, float reach_m = 6.0f);

}  // namespace panvo::simulation

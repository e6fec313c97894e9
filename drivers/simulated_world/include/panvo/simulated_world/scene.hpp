// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/palette.hpp"
#include "panvo/simulated_world/sky.hpp"

namespace panvo::simulated_world {

/// Who sees an object: a camera sees objects that share a bit with it.
enum Visibility : std::uint32_t { kToStereo = 1, kToPanorama = 2, kToShadow = 4, kToAll = 7 };

/// A model placed in the world.
struct Placement {
  std::uint32_t model = 0;                                         ///< into Scene::models
  Eigen::Affine3f world_from_model = Eigen::Affine3f::Identity();  ///< rigid and uniformly scaled
  Tint tint;                                                       ///< of all its materials named *_paint and leaves*
  std::uint32_t visibility = kToAll;
};

/// A street lamp.
struct Lamp {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< of the light, m
  float intensity = 1.0f;  ///< radiance of a white surface that it lights perpendicularly from 1 m
  bool hangs = false;      ///< lights what is below; else all around
};

/// All visible objects, in the world frame (x east, y north, z up; m).
struct Scene {
  std::shared_ptr<const Palette> palette;
  std::shared_ptr<const Sky> sky;
  std::vector<Mesh> fixed;          ///< ground and buildings
  std::vector<Mesh> models;         ///< trees, lamp posts, cars, people: base at the origin, x forward
  std::vector<Placement> standing;  ///< models that never move
  std::vector<Lamp> lamps;          ///< on at night (see Light)
};

}  // namespace panvo::simulated_world

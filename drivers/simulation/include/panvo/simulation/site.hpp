// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "panvo/simulation/road_network.hpp"
#include "panvo/simulation/scene.hpp"
#include "panvo/simulation/terrain.hpp"

namespace panvo::simulation {

/// What is built on the campus, and how.
struct SiteParameters {
  std::uint64_t seed = 1;
  double hilliness = 0.0;     ///< see Terrain
  bool weak_texture = false;  ///< the junctions marked so in the network get it
};

class KerbField;

/// The campus as it stands: roads, land and materials; the parts below build on it.
struct Site {
  /// Lays out the kerbs of `roads`, which takes some tenths of a second for a campus. Throws std::invalid_argument for
  /// a network without roads.
  Site(const SiteParameters& parameters, RoadNetwork roads, std::shared_ptr<const Palette> palette);

  SiteParameters parameters;
  RoadNetwork roads;
  Terrain terrain;
  std::shared_ptr<const Palette> palette;
  std::shared_ptr<const KerbField> kerbs;  ///< of `roads`

  /// Signed distance (m) from the nearest kerb: negative on the road, positive beside it. Smooth around the corners of
  /// junctions, whose kerbs are rounded.
  double distance_from_kerb(const Eigen::Vector2d& point) const;
  /// Ground height (m) of what one stands on: terrain, and 0.12 m more on the pavement and beyond it.
  double ground_m(const Eigen::Vector2d& point) const;
  /// 0..1: how much the texture is weakened here (1 at the heart of a junction that has weak texture).
  double weakness(const Eigen::Vector2d& point) const;
};

/// Roads with cracks, patches, markings and manholes, kerbs, pavements, grass and far land.
void build_ground(const Site& site, Scene& scene);

/// Buildings along the roads, with facades of real depth; appends the plots it used so that nothing else stands there.
struct Plot {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;                        ///< of its x axis
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  ///< m
  bool contains(const Eigen::Vector2d& point, double margin_m) const;
};
std::vector<Plot> build_buildings(const Site& site, Scene& scene);

/// Trees, hedges, lamp posts, fences, signs, bins, parked cars, where the plots leave room.
void build_furniture(const Site& site, const std::vector<Plot>& plots, Scene& scene);

/// The models of what moves; indices into Scene::models.
struct MoverModels {
  std::vector<std::uint32_t> cars, vans, people;
  std::uint32_t own_vehicle = 0;  ///< carries the rig; base_link at its origin, on the ground below its middle
};
MoverModels build_mover_models(const Palette& palette, std::uint64_t seed, Scene& scene);

}  // namespace panvo::simulation

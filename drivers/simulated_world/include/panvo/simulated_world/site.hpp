// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "panvo/simulated_world/road_network.hpp"
#include "panvo/simulated_world/scene.hpp"
#include "panvo/simulated_world/terrain.hpp"

namespace panvo::simulated_world {

/// What lies along the roads.
enum class Layout {
  kVaried,    ///< buildings of many kinds
  kRows,      ///< all buildings of one use are alike in every detail, at equal distances
  kTwins,     ///< junctions go in pairs with the same buildings along their roads
  kCarParks,  ///< car parks with equal bays instead of buildings
  kHall,      ///< indoors: aisles instead of roads, between pillars and shelves under one roof; flat
  kFields,    ///< meadows: nothing stands nearer than 70 m to a road
};

/// Parameters of the campus.
struct SiteParameters {
  std::uint64_t seed = 1;
  double hilliness = 0.0;     ///< see Terrain
  bool weak_texture = false;  ///< applied to the junctions marked in the network
  Layout layout = Layout::kVaried;
  Season season = Season::kSummer;
  bool wet = false;                    ///< after rain: water on roads and pavements
  std::optional<std::uint64_t> day{};  ///< another day: other cars are parked, a hall holds other goods
};

class KerbField;

/// The base of the campus: roads, terrain and materials. The functions below build on it.
struct Site {
  /// Computes the kerbs of `roads`, which takes several tenths of a second for a campus. Throws std::invalid_argument
  /// for a network without roads.
  Site(const SiteParameters& parameters, RoadNetwork roads, std::shared_ptr<const Palette> palette);

  SiteParameters parameters;
  RoadNetwork roads;
  Terrain terrain;
  std::shared_ptr<const Palette> palette;
  std::shared_ptr<const KerbField> kerbs;  ///< of `roads`

  /// Signed distance (m) from the nearest kerb: negative on the road, positive beside it. Smooth at the rounded corners
  /// of junctions.
  double distance_from_kerb(const Eigen::Vector2d& point) const;
  /// Ground height (m): the terrain, plus 0.12 m on and beyond the pavement, if there is one.
  double ground_m(const Eigen::Vector2d& point) const;
  /// 0..1: degree to which the texture is weakened (1 at the centre of a junction with weak texture).
  double weakness(const Eigen::Vector2d& point) const;
};

/// Builds roads with cracks, patches, markings and manholes, kerbs, pavements, grass and distant land.
void build_ground(const Site& site, Scene& scene);

/// A rectangular area on the ground.
struct Plot {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;                        ///< of its x axis
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  ///< m
  bool contains(const Eigen::Vector2d& point, double margin_m) const;
};
/// Builds buildings along the roads, with facades of real depth. Returns the occupied plots.
std::vector<Plot> build_buildings(const Site& site, Scene& scene);

/// Places trees, hedges, lamp posts, fences, signs, bins and parked cars outside the plots.
void build_furniture(const Site& site, const std::vector<Plot>& plots, Scene& scene);

/// Builds a hall instead of ground, buildings and furniture: floor, pillars, shelves, offices, machines, roof and lamps.
void build_hall(const Site& site, Scene& scene);

/// The models of moving objects; indices into Scene::models.
struct MoverModels {
  std::vector<std::uint32_t> cars, vans, people;
  std::uint32_t own_vehicle = 0;  ///< carries the rig; base_link at its origin, on the ground below its centre
};
/// Height of the top of the own vehicle's body, m, at a point in base_link; 0 outside the body.
double own_vehicle_height_m(double x_m, double y_m);
MoverModels build_mover_models(const Palette& palette, std::uint64_t seed, Scene& scene);

}  // namespace panvo::simulated_world

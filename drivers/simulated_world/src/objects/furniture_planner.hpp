// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "../ground/ground_zones.hpp"
#include "../plots.hpp"
#include "furniture_models.hpp"
#include "plants.hpp"

namespace panvo::simulated_world {

// Helpers shared by the planner's files.

inline constexpr double kParkedAgain = 0.7;  // share of the bays taken on the usual day that are taken on another one

template <typename T>
const T& pick(Random& random, const std::vector<T>& choices) {
  return choices[static_cast<std::size_t>(random.below(static_cast<int>(choices.size())))];
}

/// The point at (x, y) in a plot's frame.
inline Eigen::Vector2d on(const Plot& plot, double x, double y) {
  const double c = std::cos(plot.heading_rad), s = std::sin(plot.heading_rad);
  return plot.centre + Eigen::Vector2d(c * x - s * y, s * x + c * y);
}

/// Indices into Scene::models.
struct FurnitureModels {
  std::vector<std::uint32_t> street_trees, lawn_trees, conifers, shrubs, flower_beds, hedges, low_hedges, fences, cars,
      vans, signs, stop_signs;
  std::uint32_t lamp = 0, lantern = 0, litter_bin = 0, wheelie_bin = 0, bench = 0, bollard = 0, hydrant = 0,
                cabinet = 0, bicycles = 0, notice_board = 0;
};
FurnitureModels build_furniture_models(const Palette& palette, std::uint64_t seed, Scene& scene);

/// Decides where furniture stands, and places it.
class FurniturePlanner {
 public:
  FurniturePlanner(const Site& site, const std::vector<Plot>& plots, const FurnitureModels& models, Scene& scene);

  void furnish_open_plots();  ///< car parks, plazas and groves
  void furnish_kerbs();       ///< lamps, signs, bins, parked cars
  void fill_drives();         ///< beside buildings, most with a car
  void edge_gardens();        ///< hedges, fences and walls in front of buildings
  void plant_rows();          ///< trees along roads
  void plant_at_walls();      ///< shrubs and flowers
  void scatter_trees();       ///< on lawns, and in a belt around the campus
  void plant_horizon();       ///< woods beyond the fields

 private:
  /// Whether an object of that radius (m) fits: off the road, outside buildings, clear of other objects.
  bool has_room(const Eigen::Vector2d& point, double radius_m, double min_from_kerb_m) const;
  bool has_room_for_car(const Eigen::Vector2d& point, double heading_rad, double min_from_kerb_m) const;
  /// Width (m) of the pavement at that point.
  double pavement_m(const Eigen::Vector2d& point) const;
  void occupy(const Eigen::Vector2d& point, double radius_m);
  /// Places a model with its x axis along `heading_rad`.
  void stand(std::uint32_t model, const Eigen::Vector2d& point, double heading_rad, double scale = 1.0, Tint tint = {});
  /// As stand() if there is room, and marks the area as occupied.
  bool try_to_stand(std::uint32_t model, const Eigen::Vector2d& point, double heading_rad, double radius_m,
                    double min_from_kerb_m, double scale = 1.0, Tint tint = {});
  void plant(const std::vector<std::uint32_t>& kinds, const Eigen::Vector2d& point, double min_from_kerb_m,
             double spacing_m, Random& random);
  /// Into a bay that is taken on the usual day; on another day it may be empty, or hold another car.
  void park_car(const Eigen::Vector2d& point, double heading_rad, Random& random);
  void park_along(int road, bool is_left, double length_m, Random& random);
  void furnish_car_park(const PlannedPlot& planned, Random& random);
  void furnish_plaza(const PlannedPlot& planned, Random& random);
  void furnish_grove(const PlannedPlot& planned, Random& random);
  /// Covers a plot with a surface slightly above the ground.
  void pave(const Plot& plot, std::uint16_t material, Tint tint);

  struct Disc {
    Eigen::Vector2d centre;
    double radius_m;
  };
  using Cell = std::pair<int, int>;
  static Cell cell_of(const Eigen::Vector2d& point);

  const Site& site_;
  const std::vector<Plot>& plots_;
  std::vector<PlannedPlot> planned_;
  const FurnitureModels& models_;
  Scene& scene_;
  Random random_;
  GroundZones zones_;
  std::map<Cell, std::vector<Disc>> taken_;
  std::uint64_t bays_ = 0;  ///< so far
};

}  // namespace panvo::simulated_world

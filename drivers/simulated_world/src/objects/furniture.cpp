// SPDX-License-Identifier: Apache-2.0
#include "furniture_planner.hpp"

namespace panvo::simulated_world {

void build_furniture(const Site& site, const std::vector<Plot>& plots, Scene& scene) {
  const FurnitureModels models = build_furniture_models(*site.palette, site.parameters.seed, scene);
  FurniturePlanner planner(site, plots, models, scene);
  // objects with the fewest possible positions come first
  planner.furnish_open_plots();
  planner.furnish_kerbs();
  planner.fill_drives();
  planner.edge_gardens();
  planner.plant_rows();
  planner.plant_at_walls();
  planner.scatter_trees();
}

}  // namespace panvo::simulated_world

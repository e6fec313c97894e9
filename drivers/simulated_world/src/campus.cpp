// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/campus.hpp"

namespace panvo::simulated_world {

Campus build_campus(const SiteParameters& parameters, const std::filesystem::path& assets) {
  auto palette = std::make_shared<const Palette>(parameters.seed, assets, parameters.season, parameters.wet);
  auto site = std::make_shared<const Site>(parameters, campus_roads(parameters.seed), palette);
  auto scene = std::make_shared<Scene>();
  scene->palette = palette;
  scene->sky = std::make_shared<const Sky>(parameters.seed);
  if (parameters.layout == Layout::kHall) {
    build_hall(*site, *scene);
  } else {
    build_ground(*site, *scene);
    const auto plots = build_buildings(*site, *scene);
    build_furniture(*site, plots, *scene);
  }
  const auto movers = build_mover_models(*palette, parameters.seed, *scene);
  return {site, scene, movers};
}

}  // namespace panvo::simulated_world

// SPDX-License-Identifier: Apache-2.0
#include "hall_parts.hpp"

namespace panvo::simulated_world {
namespace {

/// The roads and what stands beside them.
HallArea area_around(const RoadNetwork& roads) {
  constexpr float kBeside_m = 24.0f;
  HallArea area{Eigen::Vector2f::Constant(1e9f), Eigen::Vector2f::Constant(-1e9f)};
  for (const Road& road : roads.roads) {
    for (const auto& point : road.centre_line) {
      area.low = area.low.cwiseMin(point.cast<float>());
      area.high = area.high.cwiseMax(point.cast<float>());
    }
  }
  return {area.low.array() - kBeside_m, area.high.array() + kBeside_m};
}

}  // namespace

void build_hall(const Site& site, Scene& scene) {
  const auto plots = plan_plots(site);
  build_hall_shell(site, area_around(site.roads), plots, scene);
  const Random random(site.parameters.seed, "hall");
  for (std::size_t i = 0; i < plots.size(); ++i) {
    scene.fixed.push_back(build_hall_plot(site, plots[i], random.part(i)));
  }
}

}  // namespace panvo::simulated_world

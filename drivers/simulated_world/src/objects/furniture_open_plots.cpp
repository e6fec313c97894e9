// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "../shapes.hpp"
#include "furniture_planner.hpp"

namespace panvo::simulated_world {

void FurniturePlanner::furnish_open_plots() {
  for (std::size_t number = 0; number < planned_.size(); ++number) {
    const PlannedPlot& planned = planned_[number];
    if (planned.use != PlotUse::kOpen) continue;
    Random random = random_.part(6).part(number);
    const double kind = random.uniform();
    if (kind < 0.45 || site_.parameters.layout == Layout::kCarParks) {
      furnish_car_park(planned, random);
    } else if (kind < 0.7) {
      furnish_plaza(planned, random);
    } else {
      furnish_grove(planned, random);
    }
  }
}

void FurniturePlanner::pave(const Plot& plot, std::uint16_t material, Tint tint) {
  constexpr double kStep_m = 1.5, kAbove_m = 0.045;
  const int columns = std::max(1, static_cast<int>(plot.size.x() / kStep_m)),
            rows = std::max(1, static_cast<int>(plot.size.y() / kStep_m));
  std::vector<Eigen::Vector3f> grid;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const Eigen::Vector2d point = on(plot, (static_cast<double>(column) / columns - 0.5) * plot.size.x(),
                                       (static_cast<double>(row) / rows - 0.5) * plot.size.y());
      const bool is_edge = row == 0 || row == rows || column == 0 || column == columns;
      grid.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()),
                        static_cast<float>(site_.ground_m(point) + (is_edge ? -0.03 : kAbove_m)));
    }
  }
  Mesh mesh;
  add_surface(
      mesh, grid, columns + 1, [&](int, int) { return material; }, tint);
  scene_.fixed.push_back(std::move(mesh));
}

void FurniturePlanner::furnish_car_park(const PlannedPlot& planned, Random& random) {
  const Plot& plot = planned.plot;
  pave(plot, site_.palette->find("asphalt_patch"), grey(1.0f));
  const Eigen::Vector2d half = 0.5 * plot.size;
  const std::uint16_t marking = site_.palette->find("marking");
  Mesh lines;
  const auto height = [&](const Eigen::Vector2d& point) {
    return Eigen::Vector3f(static_cast<float>(point.x()), static_cast<float>(point.y()),
                           static_cast<float>(site_.ground_m(point) + 0.055));
  };
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half.y() - 2.8);
    if (side > 0.0 && plot.size.y() < 13.0) continue;
    for (double x = -half.x() + 1.0; x < half.x() - 1.0; x += 2.6) {
      lines.add_quad(height(on(plot, x - 0.06, y - 2.3)), height(on(plot, x + 0.06, y - 2.3)),
                     height(on(plot, x + 0.06, y + 2.3)), height(on(plot, x - 0.06, y + 2.3)), marking);
      if (x + 2.6 > half.x() - 0.5 || !random.chance(0.62)) continue;
      park_car(on(plot, x + 1.3, y + random.uniform(-0.25, 0.25)), plot.heading_rad + 0.5 * std::numbers::pi, random);
    }
  }
  scene_.fixed.push_back(std::move(lines));
  for (double x = -half.x(); x <= half.x(); x += 2.0) {
    for (double y = -half.y(); y <= half.y(); y += 2.0) occupy(on(plot, x, y), 1.6);
  }
}

void FurniturePlanner::furnish_plaza(const PlannedPlot& planned, Random& random) {
  const Plot& plot = planned.plot;
  pave(plot, site_.palette->find(random.chance(0.5) ? "slabs" : "cobbles"), grey(1.0f));
  const Eigen::Vector2d half = 0.5 * plot.size;
  try_to_stand(models_.notice_board, on(plot, random.uniform(-0.4, 0.4) * half.x(), 0.5 * half.y()), plot.heading_rad,
               1.2, 2.8);
  for (double x = -half.x() + 2.0; x < half.x() - 1.0; x += 5.0) {
    for (const double y : {-0.6, 0.6}) {
      plant({models_.street_trees[random.chance(0.5) ? 0 : 4]}, on(plot, x, y * half.y()), 1.8, 1.0, random);
      try_to_stand(models_.bench, on(plot, x + 2.4, y * half.y()),
                   plot.heading_rad + (y > 0.0 ? 0.0 : std::numbers::pi), 0.9, 1.8);
    }
    if (random.chance(0.4)) try_to_stand(models_.lantern, on(plot, x, 0.0), plot.heading_rad, 0.5, 1.8);
  }
  try_to_stand(models_.bicycles, on(plot, 0.3 * half.x(), 0.0), plot.heading_rad, 1.5, 1.8);
  for (double x = -half.x(); x <= half.x(); x += 3.0) {
    for (double y = -half.y(); y <= half.y(); y += 3.0) occupy(on(plot, x, y), 1.0);
  }
}

void FurniturePlanner::furnish_grove(const PlannedPlot& planned, Random& random) {
  const Plot& plot = planned.plot;
  const Eigen::Vector2d half = 0.5 * plot.size;
  for (int i = 0; i < 14; ++i) {
    const Eigen::Vector2d point = on(plot, random.uniform(-1.0, 1.0) * half.x(), random.uniform(-1.0, 1.0) * half.y());
    plant(random.chance(0.3) ? models_.shrubs : models_.lawn_trees, point, 3.4, random.uniform(1.2, 2.4), random);
  }
  for (int i = 0; i < 2; ++i) {
    try_to_stand(models_.bench, on(plot, random.uniform(-0.8, 0.8) * half.x(), -0.8 * half.y()), plot.heading_rad, 0.9,
                 2.0);
  }
}

}  // namespace panvo::simulated_world

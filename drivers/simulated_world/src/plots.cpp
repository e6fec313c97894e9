// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "plot_planning.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kProbeSpacing_m = 2.0;

std::array<Eigen::Vector2d, 2> axes_of(const Plot& plot) {
  return {Eigen::Vector2d(std::cos(plot.heading_rad), std::sin(plot.heading_rad)),
          Eigen::Vector2d(-std::sin(plot.heading_rad), std::cos(plot.heading_rad))};
}

class Planner {
 public:
  explicit Planner(const Site& site) : site_(site), random_(site.parameters.seed, "plots") {}

  std::vector<PlannedPlot> plan() {
    if (site_.parameters.layout == Layout::kCarParks) {
      line_roads();
      return std::move(plots_);
    }
    // large ones first, while there is room
    place_some(PlotUse::kInstitute, 0.28, 1);
    place_some(PlotUse::kHall, 0.12, 2);
    place_some(PlotUse::kOpen, 0.2, 3);
    line_roads();
    return std::move(plots_);
  }

 private:
  bool is_in_rows() const {
    return site_.parameters.layout == Layout::kRows || site_.parameters.layout == Layout::kCarParks;
  }

  /// What to place there: of its own, or in rows as everywhere on the campus.
  Wish wish_for(PlotUse use, Random& random) const {
    Wish wish = draw_wish(use, random);
    if (is_in_rows()) {
      Random common = random_.part(6).part(static_cast<std::uint64_t>(use));
      wish = draw_wish(use, common);
    } else if (site_.parameters.layout == Layout::kHall) {
      wish.setback_m = random.uniform(-1.9, -0.9);  // plots begin at the aisle, without a pavement
    }
    return wish;
  }

  /// Places at most one per side of a road, with that probability.
  void place_some(PlotUse use, double probability, std::uint64_t purpose) {
    for (int road = 0; road < static_cast<int>(site_.roads.roads.size()); ++road) {
      for (const bool is_left : {false, true}) {
        Random random = random_.part(purpose).part(static_cast<std::uint64_t>(2 * road + (is_left ? 1 : 0)));
        if (!random.chance(probability)) continue;
        const double length = length_of(site_.roads.roads[static_cast<std::size_t>(road)]);
        for (int attempt = 0; attempt < 12; ++attempt) {
          if (try_to_place(wish_for(use, random),
                           roadside(site_.roads, road, random.uniform(0.25, 0.75) * length, is_left)))
            break;
        }
      }
    }
  }

  /// Places houses and town houses side by side along each road; whole neighbourhoods are of one kind.
  void line_roads() {
    for (int road = 0; road < static_cast<int>(site_.roads.roads.size()); ++road) {
      const double length = length_of(site_.roads.roads[static_cast<std::size_t>(road)]);
      for (const bool is_left : {false, true}) {
        Random random = random_.part(4).part(static_cast<std::uint64_t>(2 * road + (is_left ? 1 : 0)));
        const PlotUse use = use_along(roadside(site_.roads, road, 0.5 * length, is_left).at(10.0));
        double along = 4.0;
        while (along < length - 4.0) {
          const Wish wish = wish_for(use, random);
          const Roadside place = roadside(site_.roads, road, along + 0.5 * wish.width_m, is_left);
          if (random.chance(0.08) && !is_in_rows()) {  // a gap
            along += wish.width_m;
          } else if (try_to_place(wish, place)) {
            const double further_m = random.uniform(0.0, 5.0);
            along += wish.width_m + kGapBetweenPlots_m + (is_in_rows() ? 0.0 : further_m);
          } else {
            along += 2.0;
          }
        }
      }
    }
  }

  PlotUse use_along(const Eigen::Vector2d& point) const {
    if (site_.parameters.layout == Layout::kCarParks) return PlotUse::kOpen;
    return is_town(point) ? PlotUse::kTown : PlotUse::kHouse;
  }

  bool is_town(const Eigen::Vector2d& point) const {
    // neighbourhoods of about 120 m: two slow waves with random phases
    Random random = random_.part(5);
    const double east = random.uniform(0.0, 6.28), north = random.uniform(0.0, 6.28);
    return std::sin(point.x() / 38.0 + east) + std::sin(point.y() / 31.0 + north) > -0.35;
  }

  bool try_to_place(const Wish& wish, const Roadside& place) {
    const auto planned = fitting_plot(site_, wish, place, plots_);
    if (planned) plots_.push_back(*planned);
    return planned.has_value();
  }

  const Site& site_;
  Random random_;
  std::vector<PlannedPlot> plots_;
};

}  // namespace

double length_of(const Road& road) {
  double length = 0.0;
  for (std::size_t i = 1; i < road.centre_line.size(); ++i)
    length += (road.centre_line[i] - road.centre_line[i - 1]).norm();
  return length;
}

Roadside roadside(const RoadNetwork& roads, int road, double along_m, bool is_left) {
  const Road& line = roads.roads[static_cast<std::size_t>(road)];
  Roadside place;
  place.road = road;
  place.along_m = std::clamp(along_m, 0.0, length_of(line));
  place.to_junction_m = std::min(place.along_m, length_of(line) - place.along_m);
  place.kerb_m = 0.5 * line.width_m;
  double passed = 0.0;
  for (std::size_t i = 1; i < line.centre_line.size(); ++i) {
    const Eigen::Vector2d step = line.centre_line[i] - line.centre_line[i - 1];
    const double length = step.norm();
    if (length <= 0.0) continue;
    if (passed + length >= place.along_m || i + 1 == line.centre_line.size()) {
      // the direction over several metres, so that neighbours have similar headings
      const std::size_t before = i >= 4 ? i - 4 : 0, after = std::min(i + 3, line.centre_line.size() - 1);
      place.along = (line.centre_line[after] - line.centre_line[before]).normalized();
      place.middle = line.centre_line[i - 1] + std::min(1.0, (place.along_m - passed) / length) * step;
      break;
    }
    passed += length;
  }
  const Eigen::Vector2d left(-place.along.y(), place.along.x());
  place.outwards = is_left ? left : Eigen::Vector2d(-left);
  return place;
}

bool Plot::contains(const Eigen::Vector2d& point, double margin_m) const {
  const auto [x, y] = axes_of(*this);
  const Eigen::Vector2d from_centre = point - centre;
  return std::abs(from_centre.dot(x)) <= 0.5 * size.x() + margin_m &&
         std::abs(from_centre.dot(y)) <= 0.5 * size.y() + margin_m;
}

std::vector<Eigen::Vector2d> probes_of(const Plot& plot) {
  const auto [x, y] = axes_of(plot);
  const int columns = std::max(1, static_cast<int>(std::ceil(plot.size.x() / kProbeSpacing_m)));
  const int rows = std::max(1, static_cast<int>(std::ceil(plot.size.y() / kProbeSpacing_m)));
  std::vector<Eigen::Vector2d> probes;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      probes.emplace_back(plot.centre + (static_cast<double>(column) / columns - 0.5) * plot.size.x() * x +
                          (static_cast<double>(row) / rows - 0.5) * plot.size.y() * y);
    }
  }
  return probes;
}

bool overlap(const Plot& first, const Plot& second, double margin_m) {
  // separating axis theorem: two rectangles are disjoint exactly if the direction of one of their sides separates them
  const Eigen::Vector2d between = second.centre - first.centre;
  const auto first_axes = axes_of(first), second_axes = axes_of(second);
  for (const auto& axes : {first_axes, second_axes}) {
    for (const auto& axis : axes) {
      double reach = 0.0;
      for (int i = 0; i < 2; ++i) {
        reach += 0.5 * first.size[i] * std::abs(first_axes[static_cast<std::size_t>(i)].dot(axis));
        reach += (0.5 * second.size[i] + margin_m) * std::abs(second_axes[static_cast<std::size_t>(i)].dot(axis));
      }
      if (std::abs(between.dot(axis)) > reach) return false;
    }
  }
  return true;
}

Wish draw_wish(PlotUse use, Random& random) {
  switch (use) {
    case PlotUse::kHouse:
      return {use, random.uniform(9.0, 15.0), random.uniform(8.0, 11.0), random.uniform(4.0, 9.0)};
    case PlotUse::kTown:
      return {use, random.uniform(12.0, 24.0), random.uniform(10.0, 14.0), random.uniform(3.0, 6.0)};
    case PlotUse::kInstitute:
      return {use, random.uniform(32.0, 46.0), random.uniform(13.0, 17.0), random.uniform(5.0, 10.0)};
    case PlotUse::kHall:
      return {use, random.uniform(22.0, 34.0), random.uniform(16.0, 22.0), random.uniform(6.0, 11.0)};
    case PlotUse::kOpen:
      return {use, random.uniform(18.0, 30.0), random.uniform(12.0, 20.0), random.uniform(0.4, 1.0)};
  }
  return {};
}

std::optional<PlannedPlot> fitting_plot(const Site& site, const Wish& wish, const Roadside& place,
                                        const std::vector<PlannedPlot>& others) {
  PlannedPlot planned;
  planned.use = wish.use;
  planned.place = place;
  const double front = kPavementWidth_m + wish.setback_m;
  planned.plot.size = {wish.width_m, wish.depth_m};
  planned.plot.centre = place.at(front + 0.5 * wish.depth_m);
  // y away from the road, x to the right of it as seen from the road
  planned.plot.heading_rad = std::atan2(-place.outwards.x(), place.outwards.y());
  const double least = kPavementWidth_m + std::min(wish.setback_m, 3.0) - 0.3;
  for (const auto& probe : probes_of(planned.plot)) {
    if (site.distance_from_kerb(probe) < least) return std::nullopt;
  }
  for (const auto& other : others) {
    if (overlap(planned.plot, other.plot, kGapBetweenPlots_m)) return std::nullopt;
  }
  return planned;
}

std::vector<PlannedPlot> plan_plots(const Site& site) {
  if (site.parameters.layout == Layout::kFields) return {};
  return site.parameters.layout == Layout::kTwins ? plan_twins(site) : Planner(site).plan();
}

}  // namespace panvo::simulated_world

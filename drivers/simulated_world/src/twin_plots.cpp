// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "plot_planning.hpp"

namespace panvo::simulated_world {
namespace {

constexpr std::uint64_t kMaxRoads = 16;  // that meet at a junction

/// Junctions of the same number are twins: as many roads meet there, and others of that kind lie between them.
std::vector<std::uint64_t> pairs_of(const RoadNetwork& roads) {
  std::map<std::size_t, std::vector<std::size_t>> of_degree;
  for (std::size_t i = 0; i < roads.junctions.size(); ++i) of_degree[roads.junctions[i].roads.size()].push_back(i);
  std::vector<std::uint64_t> pairs(roads.junctions.size());
  std::uint64_t first = 0;
  for (const auto& [degree, junctions] : of_degree) {
    const std::size_t half = (junctions.size() + 1) / 2;
    for (std::size_t i = 0; i < junctions.size(); ++i) pairs[junctions[i]] = first + i % half;
    first += half;
  }
  return pairs;
}

/// A side of a road, from a junction to the middle of the road.
struct Side {
  int road = 0;
  bool is_left = false;    ///< of the road, not as seen from the junction
  bool goes_back = false;  ///< from the road's end
  double length_m = 0.0;
  std::uint64_t number = 0;  ///< equal for twins: by the order of roads around the junction, right and left from there
};

/// All sides, twins next to each other.
std::vector<Side> sides_of(const RoadNetwork& roads) {
  const auto pairs = pairs_of(roads);
  std::vector<Side> sides;
  for (int road = 0; road < static_cast<int>(roads.roads.size()); ++road) {
    const Road& line = roads.roads[static_cast<std::size_t>(road)];
    for (const bool is_end : {false, true}) {
      const auto junction = static_cast<std::size_t>(is_end ? line.to : line.from);
      const auto& around = roads.junctions[junction].roads;
      // a loop is there twice
      const auto arm = is_end ? std::find(around.rbegin(), around.rend(), road).base() - around.begin() - 1
                              : std::find(around.begin(), around.end(), road) - around.begin();
      for (const bool is_left : {false, true}) {
        const auto number = 2 * (kMaxRoads * pairs[junction] + static_cast<std::uint64_t>(arm)) + (is_left ? 1 : 0);
        sides.push_back({road, is_left != is_end, is_end, 0.5 * length_of(line), number});
      }
    }
  }
  std::ranges::stable_sort(sides, {}, &Side::number);
  return sides;
}

class TwinPlanner {
 public:
  explicit TwinPlanner(const Site& site) : site_(site), random_(site.parameters.seed, "twins") {}

  std::vector<PlannedPlot> plan() {
    const auto sides = sides_of(site_.roads);
    for (auto first = sides.begin(); first != sides.end();) {
      const auto end = std::find_if(first, sides.end(), [&](const Side& side) { return side.number != first->number; });
      line({first, end});
      first = end;
    }
    return std::move(plots_);
  }

 private:
  void line(std::span<const Side> twins) {
    constexpr int kMaxMisses = 4;
    const std::uint64_t side = twins.front().number;
    const Random random = random_.part(side);
    const bool is_town = random_.part(side / (2 * kMaxRoads)).part(1).chance(0.6);  // the whole neighbourhood
    std::vector<double> along(twins.size(), 4.0);
    int misses = 0;
    for (std::uint64_t number = 0; misses < kMaxMisses; ++number) {
      Random own = random.part(number);
      const Wish wish = draw_wish(draw_use(is_town, own), own);
      const double further_m = own.uniform(0.0, 5.0);
      if (place(twins, wish, along, side << 8 | number)) {
        for (auto& at : along) at += kGapBetweenPlots_m + further_m;
        misses = 0;
      } else {
        ++misses;
      }
    }
  }

  static PlotUse draw_use(bool is_town, Random& random) {
    const double choice = random.uniform();
    if (choice < 0.12) return PlotUse::kOpen;
    if (choice < 0.2) return PlotUse::kHall;
    if (choice < 0.32) return PlotUse::kInstitute;
    return is_town ? PlotUse::kTown : PlotUse::kHouse;
  }

  /// Places it at each twin behind `along` (m from the junction), which it then moves to its end, or nowhere.
  bool place(std::span<const Side> twins, const Wish& wish, std::vector<double>& along, std::uint64_t design) {
    constexpr double kStep_m = 1.0;
    const std::size_t before = plots_.size();
    std::vector<double> ends = along;
    for (std::size_t i = 0; i < twins.size(); ++i) {
      std::optional<PlannedPlot> found;
      for (; !found && ends[i] + 0.5 * wish.width_m < twins[i].length_m; ends[i] += kStep_m) {
        const double middle_m = ends[i] + 0.5 * wish.width_m;
        const double on_road_m = twins[i].goes_back ? 2.0 * twins[i].length_m - middle_m : middle_m;
        found = fitting_plot(site_, wish, roadside(site_.roads, twins[i].road, on_road_m, twins[i].is_left), plots_);
      }
      if (!found) {
        plots_.resize(before);
        return false;
      }
      found->design = design;
      plots_.push_back(*found);
      ends[i] += wish.width_m - kStep_m;
    }
    along = ends;
    return true;
  }

  const Site& site_;
  Random random_;
  std::vector<PlannedPlot> plots_;
};

}  // namespace

std::vector<PlannedPlot> plan_twins(const Site& site) { return TwinPlanner(site).plan(); }

}  // namespace panvo::simulated_world

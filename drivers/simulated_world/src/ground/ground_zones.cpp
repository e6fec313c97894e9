// SPDX-License-Identifier: Apache-2.0
#include "ground_zones.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../kerb_field.hpp"
#include "panvo/simulated_world/random.hpp"
#include "road_line.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kKerbWidth_m = 0.15;

Eigen::Vector3f ground_grey(double value, double warmth = 0.0) {
  return {static_cast<float>(value * (1.0 + warmth)), static_cast<float>(value),
          static_cast<float>(value * (1.0 - warmth))};
}

// The street of each road: roads connected by a bend form one street, numbered as the first of them.
std::vector<int> streets(const RoadNetwork& roads) {
  std::vector<int> street(roads.roads.size());
  std::iota(street.begin(), street.end(), 0);
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const Junction& junction : roads.junctions) {
      if (junction.roads.size() != 2) continue;
      int &a = street[static_cast<std::size_t>(junction.roads[0])],
          &b = street[static_cast<std::size_t>(junction.roads[1])];
      if (a != b) a = b = std::min(a, b), has_changed = true;
    }
  }
  return street;
}

// A random pavement: slabs to the kerb, or after a verge, setts, gravel, asphalt.
std::vector<Band> pavement(const Palette& palette, Random random, bool is_wide) {
  const double end = (is_wide ? 3.4 : 1.9) + random.uniform(0.0, 0.5);
  const Eigen::Vector3f tint = ground_grey(random.uniform(0.78, 1.0), random.uniform(-0.01, 0.03));
  const Eigen::Vector3f edging = ground_grey(random.uniform(0.75, 0.95));
  const auto paved = [&](const char* name, double from_m, double to_m, bool follows_road) {
    std::vector<Band> bands;
    if (from_m > 0.3) {
      bands.push_back({from_m - 0.1, palette.find("grass"), false, ground_grey(0.9)});
      bands.push_back({from_m, palette.find("kerb"), true, edging});
    }
    bands.push_back({to_m - 0.1, palette.find(name), follows_road, tint});
    bands.push_back({to_m, palette.find("kerb"), true, edging});
    return bands;
  };
  const double choice = random.uniform();
  if (choice < 0.34) return paved("slabs", kKerbWidth_m, end, true);
  if (choice < 0.52) return paved("slabs", 1.5, 1.5 + 0.8 * end, true);
  if (choice < 0.66) {  // slabs between two rows of setts
    std::vector<Band> bands{{0.55, palette.find("cobbles"), true, tint},
                            {end - 0.4, palette.find("slabs"), true, tint}};
    bands.push_back({end, palette.find("cobbles"), true, tint});
    return bands;
  }
  if (choice < 0.78) return paved("cobbles", kKerbWidth_m, end, true);
  if (choice < 0.90) return paved("asphalt", is_wide ? kKerbWidth_m : 1.2, is_wide ? end : 1.2 + end, false);
  return paved("gravel", is_wide ? kKerbWidth_m : 1.6, is_wide ? end : 1.6 + end, false);
}

Zone street_zone(const Site& site, int road, const Random& all) {
  Random random = all.part(static_cast<std::uint64_t>(road));
  const Palette& palette = *site.palette;
  const double width_m = site.roads.roads[static_cast<std::size_t>(road)].width_m;
  Zone zone;
  zone.road = road;
  zone.asphalt = palette.find("asphalt");
  zone.asphalt_tint = ground_grey(random.uniform(0.78, 1.0), random.uniform(-0.015, 0.03));
  zone.wear = static_cast<float>(random.uniform(-1.0, 1.0));
  zone.damage = static_cast<float>(random.uniform(0.15, 1.0));
  zone.has_gutter = random.chance(0.55);
  zone.gutter = zone.has_gutter ? palette.find(random.chance(0.5) ? "cobbles" : "concrete") : zone.asphalt;
  const double choice = random.uniform();
  zone.centre_line = width_m < 6.3 || choice < 0.25 ? CentreLine::kNone
                     : choice < 0.65                ? CentreLine::kDashed
                     : choice < 0.9                 ? CentreLine::kLongDashed
                                                    : CentreLine::kDouble;
  zone.has_edge_lines = width_m > 6.8 && random.chance(0.3);
  zone.has_parking_on_left = !zone.has_edge_lines && random.chance(0.35);
  zone.has_parking_on_right = !zone.has_edge_lines && random.chance(0.35);
  zone.beside = pavement(palette, random.part(1), false);
  return zone;
}

Zone crossing_zone(const Site& site, int junction, const Random& all) {
  Random random = all.part(1000 + static_cast<std::uint64_t>(junction));
  const Palette& palette = *site.palette;
  const Junction& here = site.roads.junctions[static_cast<std::size_t>(junction)];
  const bool is_weak = site.parameters.weak_texture && here.has_weak_texture;
  Zone zone;
  zone.junction = junction;
  zone.asphalt = palette.find(is_weak ? "asphalt_smooth" : "asphalt");
  zone.asphalt_tint = ground_grey(random.uniform(0.8, 1.0), random.uniform(-0.01, 0.02));
  zone.damage = is_weak ? 0.0f : static_cast<float>(random.uniform(0.2, 1.0));
  zone.gutter = zone.asphalt;
  zone.beside = is_weak ? std::vector<Band>{{2.2, palette.find("asphalt_smooth"), false, ground_grey(0.95)}}
                        : pavement(palette, random.part(1), random.chance(0.5));
  zone.origin = here.position;
  const Road& road = site.roads.roads[static_cast<std::size_t>(here.roads.front())];
  const RoadLine line(road.centre_line);
  zone.forward = road.from == junction ? line.forward(3.0) : line.forward(line.length_m() - 3.0);
  return zone;
}

}  // namespace

GroundZones::GroundZones(const Site& site) : site_(site) {
  const Random random(site.parameters.seed, "ground zones");
  const std::vector<int> streets_of = streets(site.roads);
  street_of_.resize(site.roads.roads.size());
  for (std::size_t road = 0; road < street_of_.size(); ++road) {
    if (streets_of[road] == static_cast<int>(road)) {
      street_of_[road] = static_cast<int>(zones_.size());
      zones_.push_back(street_zone(site, static_cast<int>(road), random));
    } else {
      street_of_[road] = street_of_[static_cast<std::size_t>(streets_of[road])];
    }
  }
  for (std::size_t i = 0; i < site.roads.junctions.size(); ++i) {
    crossing_of_.push_back(site.roads.junctions[i].is_crossing() ? static_cast<int>(zones_.size()) : -1);
    if (crossing_of_.back() >= 0) zones_.push_back(crossing_zone(site, static_cast<int>(i), random));
  }
  // a mouth is the point where both kerbs are parallel to the road again
  for (const Road& road : site.roads.roads) {
    const RoadLine line(road.centre_line);
    const double max_m = 0.45 * line.length_m();
    const auto mouth = [&](bool from_end) {
      double last_curved_m = 0.0;
      for (double m = 0.0; m < max_m; m += 0.5) {
        const double along_m = from_end ? line.length_m() - m : m;
        for (const double side_m : {-0.5 * road.width_m, 0.5 * road.width_m}) {
          if (std::abs(site.kerbs->distance_m(line.beside(along_m, side_m))) > 0.06) last_curved_m = m;
        }
      }
      return std::min(last_curved_m + 1.0, max_m);
    };
    mouths_m_.push_back({mouth(false), line.length_m() - mouth(true)});
  }
  // equal for all roads of a crossing: where two of them are equally near, both give the same distance from it
  std::vector<double> reach_of_crossing(site.roads.junctions.size(), 0.0);
  for (std::size_t i = 0; i < site.roads.roads.size(); ++i) {
    const Road& road = site.roads.roads[i];
    double &from = reach_of_crossing[static_cast<std::size_t>(road.from)],
           &to = reach_of_crossing[static_cast<std::size_t>(road.to)];
    from = std::max(from, mouths_m_[i][0] + 0.5);
    to = std::max(to, site.kerbs->length_m(static_cast<int>(i)) - mouths_m_[i][1] + 0.5);
  }
  for (std::size_t i = 0; i < site.roads.roads.size(); ++i) {
    const Road& road = site.roads.roads[i];
    const double length_m = site.kerbs->length_m(static_cast<int>(i)), max_m = 0.48 * length_m;
    const auto reach = [&](int junction) {
      return has_crossing(junction) ? std::min(max_m, reach_of_crossing[static_cast<std::size_t>(junction)]) : -1e6;
    };
    reach_m_.push_back({reach(road.from), length_m - reach(road.to)});
  }
}

GroundZones::Place GroundZones::at(const Eigen::Vector2d& point) const {
  Place place;
  place.nearest = site_.kerbs->nearest_road(point);
  const auto road = static_cast<std::size_t>(place.nearest.road);
  const double after_m = place.nearest.along_m - reach_m_[road][0],
               before_m = reach_m_[road][1] - place.nearest.along_m;
  place.into_street_m = std::min(after_m, before_m);
  place.street = street_of_[road];
  const Road& here = site_.roads.roads[road];
  const bool is_at_start = after_m < before_m;
  const auto junction = static_cast<std::size_t>(is_at_start ? here.from : here.to);
  place.crossing = crossing_of_[junction];
  place.off_crossing_m = place.into_street_m;
  if (place.crossing >= 0) {
    const double reach_m =
        is_at_start ? reach_m_[road][0] : site_.kerbs->length_m(place.nearest.road) - reach_m_[road][1];
    place.off_crossing_m = (point - site_.roads.junctions[junction].position).norm() - reach_m;
  }
  return place;
}

}  // namespace panvo::simulated_world

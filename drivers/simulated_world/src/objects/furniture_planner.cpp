// SPDX-License-Identifier: Apache-2.0
#include "furniture_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "../shapes.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kCell_m = 8.0, kMaxDisc_m = 4.0;

/// A random car colour: mostly white, grey and black.
Tint car_colour(Random& random) {
  const double kind = random.uniform();
  if (kind < 0.7) {
    const float bright = kind < 0.22   ? between(random, 0.85, 1.0)
                         : kind < 0.48 ? between(random, 0.25, 0.55)
                                       : between(random, 0.02, 0.08);
    return tint_of(bright, bright, bright * between(random, 0.97, 1.05));
  }
  if (kind < 0.82) return tint_of(0.06f, 0.13f, between(random, 0.3, 0.55));
  if (kind < 0.93) return tint_of(between(random, 0.4, 0.65), 0.04f, 0.04f);
  return tint_of(between(random, 0.1, 0.6), between(random, 0.25, 0.45), between(random, 0.1, 0.2));
}

/// Heading at which a model's -y side faces the road.
double facing_road(const Roadside& place) { return std::atan2(-place.outwards.x(), place.outwards.y()); }

double heading_of(const Eigen::Vector2d& direction) { return std::atan2(direction.y(), direction.x()); }

}  // namespace

FurniturePlanner::FurniturePlanner(const Site& site, const std::vector<Plot>& plots, const FurnitureModels& models,
                                   Scene& scene)
    : site_(site),
      plots_(plots),
      planned_(plan_plots(site)),
      models_(models),
      scene_(scene),
      random_(site.parameters.seed, "furniture"),
      zones_(site) {}

FurniturePlanner::Cell FurniturePlanner::cell_of(const Eigen::Vector2d& point) {
  return {static_cast<int>(std::floor(point.x() / kCell_m)), static_cast<int>(std::floor(point.y() / kCell_m))};
}

bool FurniturePlanner::has_room(const Eigen::Vector2d& point, double radius_m, double min_from_kerb_m) const {
  if (site_.distance_from_kerb(point) < min_from_kerb_m) return false;
  for (const auto& plot : plots_) {
    if (plot.contains(point, radius_m)) return false;
  }
  const Cell cell = cell_of(point);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      const auto discs = taken_.find({cell.first + x, cell.second + y});
      if (discs == taken_.end()) continue;
      for (const auto& disc : discs->second) {
        if ((disc.centre - point).norm() < disc.radius_m + radius_m) return false;
      }
    }
  }
  return true;
}

void FurniturePlanner::occupy(const Eigen::Vector2d& point, double radius_m) {
  taken_[cell_of(point)].push_back({point, std::min(radius_m, kMaxDisc_m)});
}

void FurniturePlanner::stand(std::uint32_t model, const Eigen::Vector2d& point, double heading_rad, double scale,
                             Tint tint) {
  Placement placement;
  placement.model = model;
  placement.tint = tint;
  placement.world_from_model = Eigen::Translation3f(static_cast<float>(point.x()), static_cast<float>(point.y()),
                                                    static_cast<float>(site_.ground_m(point))) *
                               Eigen::AngleAxisf(static_cast<float>(heading_rad), Eigen::Vector3f::UnitZ()) *
                               Eigen::UniformScaling<float>(static_cast<float>(scale));
  scene_.standing.push_back(placement);
}

bool FurniturePlanner::try_to_stand(std::uint32_t model, const Eigen::Vector2d& point, double heading_rad,
                                    double radius_m, double min_from_kerb_m, double scale, Tint tint) {
  if (!has_room(point, radius_m, min_from_kerb_m)) return false;
  stand(model, point, heading_rad, scale, tint);
  occupy(point, radius_m);
  return true;
}

void FurniturePlanner::plant(const std::vector<std::uint32_t>& kinds, const Eigen::Vector2d& point,
                             double min_from_kerb_m, double spacing_m, Random& random) {
  const float bright = between(random, 0.78, 1.0);
  const Tint tint = tint_of(bright * between(random, 0.85, 1.0), bright, bright * between(random, 0.8, 1.0));
  try_to_stand(pick(random, kinds), point, random.uniform(0.0, 6.28), spacing_m, min_from_kerb_m,
               random.uniform(0.8, 1.2), tint);
}

void FurniturePlanner::park_car(const Eigen::Vector2d& point, double heading_rad, Random& random) {
  const auto draw = [&](Random& own) {
    Placement car;
    car.model = own.chance(0.1) ? pick(own, models_.vans) : pick(own, models_.cars);
    car.tint = car_colour(own);
    const double turn_rad = own.uniform(-0.03, 0.03);
    return std::pair(car, turn_rad + (own.chance(0.25) ? std::numbers::pi : 0.0));
  };
  auto [car, turn_rad] = draw(random);
  bool is_taken = true;
  if (const auto day = site_.parameters.day) {
    Random today = random_.part(8).part(*day).part(bays_++);
    is_taken = today.chance(kParkedAgain);
    std::tie(car, turn_rad) = draw(today);
  }
  if (is_taken) stand(car.model, point, heading_rad + turn_rad, 1.0, car.tint);
  const Eigen::Vector2d along(std::cos(heading_rad), std::sin(heading_rad));
  for (const double offset : {-1.5, 0.0, 1.5}) occupy(point + offset * along, 1.0);
}

void FurniturePlanner::furnish_kerbs() {
  for (int road = 0; road < static_cast<int>(site_.roads.roads.size()); ++road) {
    const double length = length_of(site_.roads.roads[static_cast<std::size_t>(road)]);
    for (const bool is_left : {false, true}) {
      Random random = random_.part(1).part(static_cast<std::uint64_t>(2 * road + (is_left ? 1 : 0)));
      park_along(road, is_left, length, random);
      const bool has_lamps = is_left == (road % 2 == 0);
      const std::uint32_t lamp = road % 3 == 0 ? models_.lantern : models_.lamp;
      const double spacing = road % 3 == 0 ? 17.0 : 27.0;
      for (double along = 12.0; has_lamps && along < length - 6.0; along += spacing) {
        const Roadside place = roadside(site_.roads, road, along, is_left);
        try_to_stand(lamp, place.at(0.55), facing_road(place), 0.4, 0.45);
      }
      // for drivers who approach the junction on the right-hand side
      const double sign_along = is_left ? 9.0 : length - 9.0;
      const Roadside sign_place = roadside(site_.roads, road, sign_along, is_left);
      const double to_driver = heading_of(sign_place.along) + (is_left ? 0.5 : -0.5) * std::numbers::pi;
      if (random.chance(0.7)) {
        try_to_stand(random.chance(0.4) ? models_.stop_signs.front() : pick(random, models_.signs), sign_place.at(0.5),
                     to_driver, 0.4, 0.35);
      }
      for (double along = random.uniform(6.0, 14.0); along < length - 6.0; along += random.uniform(7.0, 16.0)) {
        const Roadside place = roadside(site_.roads, road, along, is_left);
        const double heading = facing_road(place);
        const double kind = random.uniform();
        if (kind < 0.14) {
          try_to_stand(models_.litter_bin, place.at(0.6), heading, 0.35, 0.3);
        } else if (kind < 0.24) {
          try_to_stand(models_.cabinet, place.at(2.35), heading, 0.6, 1.5);
        } else if (kind < 0.34) {
          try_to_stand(models_.bench, place.at(2.3), heading, 0.9, 1.5);
        } else if (kind < 0.42) {
          try_to_stand(models_.hydrant, place.at(0.6), heading, 0.3, 0.3);
        } else if (kind < 0.56) {
          for (int i = 0; i < 1 + random.below(3); ++i) {
            const Eigen::Vector2d point = place.at(2.3) + 0.72 * i * place.along;
            try_to_stand(models_.wheelie_bin, point, heading + random.uniform(-0.25, 0.25), 0.34, 1.5);
          }
        } else if (kind < 0.64) {
          for (int i = 0; i < 5; ++i)
            try_to_stand(models_.bollard, place.at(0.4) + 1.4 * i * place.along, heading, 0.15, 0.25);
        } else if (kind < 0.7) {
          try_to_stand(models_.notice_board, place.at(2.4), heading, 1.1, 1.5);
        } else if (kind < 0.76) {
          try_to_stand(pick(random, models_.signs), place.at(0.5), heading + (random.chance(0.5) ? 1.57 : -1.57), 0.4,
                       0.35);
        }
      }
    }
  }
}

double FurniturePlanner::pavement_m(const Eigen::Vector2d& point) const {
  const GroundZones::Place place = zones_.at(point);
  double width_m = kPavementWidth_m;
  // near a crossing, its own pavement counts, too
  for (const int number : {place.street, place.into_street_m < 3.0 ? place.crossing : -1}) {
    if (number < 0) continue;
    const Zone& zone = zones_.zone(number);
    if (!zone.beside.empty()) width_m = std::max(width_m, zone.beside.back().to_m);
  }
  return width_m;
}

bool FurniturePlanner::has_room_for_car(const Eigen::Vector2d& point, double heading_rad,
                                        double min_from_kerb_m) const {
  const Eigen::Vector2d along(std::cos(heading_rad), std::sin(heading_rad));
  for (const double offset : {-1.5, 0.0, 1.5}) {
    if (!has_room(point + offset * along, 1.0, min_from_kerb_m)) return false;
  }
  return true;
}

void FurniturePlanner::park_along(int road, bool is_left, double length_m, Random& random) {
  // at the kerb of wide roads, else on the verge behind the pavement, and less often
  const bool is_wide = site_.roads.roads[static_cast<std::size_t>(road)].width_m >= 8.0;
  const Roadside halfway = roadside(site_.roads, road, 0.5 * length_m, is_left);
  const double from_kerb = is_wide ? -1.0 : pavement_m(halfway.at(1.0)) + 1.15;
  if (!is_wide && !random.chance(0.25)) return;
  const double density = random.uniform(0.3, 0.8) * (is_wide ? 1.0 : 0.6);
  for (double along = 17.0; along < length_m - 17.0; along += random.uniform(5.4, 6.6)) {
    if (!random.chance(density)) continue;
    const Roadside place = roadside(site_.roads, road, along, is_left);
    const Eigen::Vector2d point = place.at(from_kerb);
    const double heading = heading_of(place.along) + (is_left ? std::numbers::pi : 0.0);
    if (std::abs(site_.distance_from_kerb(point) - from_kerb) > 0.2 ||
        !has_room_for_car(point, heading, from_kerb - 0.3))
      continue;
    park_car(point, heading, random);
  }
}

void FurniturePlanner::fill_drives() {
  const std::uint16_t paved[] = {site_.palette->find("slabs"), site_.palette->find("asphalt_patch"),
                                 site_.palette->find("gravel"), site_.palette->find("cobbles")};
  for (std::size_t number = 0; number < planned_.size(); ++number) {
    const PlannedPlot& planned = planned_[number];
    Random random = random_.part(7).part(number);
    if (planned.use == PlotUse::kOpen || !random.chance(0.55)) continue;
    const double front = -0.5 * planned.plot.size.y(), side = random.chance(0.5) ? 1.0 : -1.0;
    const double x = side * (0.5 * planned.plot.size.x() + 1.5);
    const double kerb_y =
        front - site_.distance_from_kerb(on(planned.plot, 0.0, front)) + pavement_m(planned.place.at(1.0));
    const double y = kerb_y + 3.4;
    const double heading = planned.plot.heading_rad + 0.5 * std::numbers::pi;
    if (!has_room_for_car(on(planned.plot, x, y), heading, kPavementWidth_m)) continue;
    Plot drive;
    drive.heading_rad = planned.plot.heading_rad;
    drive.size = {2.7, 7.0};
    drive.centre = on(planned.plot, x, kerb_y + 3.5);
    pave(drive, paved[random.below(4)], grey(1.0f));
    for (double step = 0.6; step < 7.0; step += 1.6) occupy(on(planned.plot, x, kerb_y + step), 1.0);
    if (random.chance(0.75)) park_car(on(planned.plot, x, y), heading, random);
  }
}

void FurniturePlanner::edge_gardens() {
  for (std::size_t number = 0; number < planned_.size(); ++number) {
    const PlannedPlot& planned = planned_[number];
    Random random = random_.part(2).part(number);
    const double share = planned.use == PlotUse::kHouse ? 0.85 : planned.use == PlotUse::kOpen ? 0.4 : 0.35;
    if (!random.chance(share)) continue;
    const double kind = random.uniform();
    const std::vector<std::uint32_t>& segments = kind < 0.4   ? models_.hedges
                                                 : kind < 0.6 ? models_.low_hedges
                                                              : models_.fences;
    const std::uint32_t fence = pick(random, models_.fences);
    const double half = 0.5 * planned.plot.size.x() + 2.0;
    const double gate = random.uniform(-0.5, 0.5) * half;
    const double length = length_of(site_.roads.roads[static_cast<std::size_t>(planned.place.road)]);
    const Eigen::Vector2d right(std::cos(planned.plot.heading_rad), std::sin(planned.plot.heading_rad));
    for (double offset = -half; offset <= half; offset += 2.0) {
      if (std::abs(offset - gate) < 1.6) continue;
      const bool is_left =
          planned.place.outwards.dot(Eigen::Vector2d(-planned.place.along.y(), planned.place.along.x())) > 0.0;
      const double along = planned.place.along_m + offset * (right.dot(planned.place.along) > 0.0 ? 1.0 : -1.0);
      if (along < 1.0 || along > length - 1.0) continue;
      const Roadside place = roadside(site_.roads, planned.place.road, along, is_left);
      const double from_kerb = pavement_m(place.at(1.0)) + 0.35;
      const Eigen::Vector2d point = place.at(from_kerb);
      if (std::abs(site_.distance_from_kerb(point) - from_kerb) > 0.25) continue;
      const std::uint32_t model = &segments == &models_.fences ? fence : pick(random, segments);
      const bool is_turned = &segments != &models_.fences && random.chance(0.5);
      const float bright = between(random, 0.9, 1.0);
      if (!has_room(point, 0.75, 1.5)) continue;
      stand(model, point, facing_road(place) + (is_turned ? std::numbers::pi : 0.0), 1.0, grey(bright));
      occupy(point, 0.5);
      occupy(point + 0.8 * place.along, 0.4);
      occupy(point - 0.8 * place.along, 0.15);
    }
  }
}

}  // namespace panvo::simulated_world

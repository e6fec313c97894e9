// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "../kerb_field.hpp"
#include "ground_parts.hpp"
#include "panvo/simulated_world/random.hpp"
#include "road_line.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kLidRadius_m = 0.335;  // radius of the lid in the material's picture
constexpr double kLidPeriod_m = 0.7;

class Coverer {
 public:
  Coverer(const Site& site, Drape& drape) : site_(site), drape_(drape) {
    iron_.material = site.palette->find("manhole");
    iron_.lift_m = 0.0055;
    frame_.material = site.palette->find("asphalt_patch");
    frame_.lift_m = 0.0045;
    concrete_ = site.palette->find("concrete");
  }

  void manhole(const Eigen::Vector2d& middle, const Eigen::Vector2d& forward, Random random) {
    if (is_bare(site_, middle)) return;
    // set into a square or round frame of asphalt or concrete
    Cloth frame = frame_;
    frame.origin = middle;
    frame.tint = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(0.7, 1.0)));
    const double choice = random.uniform();
    if (choice < 0.45) {
      const double half_m = random.uniform(0.45, 0.7);
      drape_.ragged({middle, forward, half_m, half_m}, 0.015, frame, random.part(0));
    } else if (choice < 0.8) {
      frame.material = concrete_;
      drape_.disc(middle, kLidRadius_m + random.uniform(0.06, 0.12), 20, frame);
    }
    iron_.forward = forward;
    iron_.origin = corner(middle, forward);
    iron_.tint = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(0.7, 1.0)));
    drape_.disc(middle, kLidRadius_m, 24, iron_);
  }

  // Adds a small iron plate.
  void plate(const Rectangle& where, double lift_m, Random random) {
    if (is_bare(site_, where.middle)) return;
    Cloth iron = iron_;
    iron.lift_m = lift_m;
    iron.forward = where.forward;
    iron.origin = where.middle;
    iron.tint = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(0.6, 1.0)));
    drape_.rectangle(where, iron);
  }

  // Adds bars over a dark pit at the kerb; `forward` runs along the kerb.
  void grate(const Eigen::Vector2d& middle, const Eigen::Vector2d& forward, Random random) {
    if (is_bare(site_, middle)) return;
    const Rectangle where{middle, forward, 0.25, 0.18};
    Cloth cloth = iron_;
    cloth.origin = middle;
    cloth.forward = forward;
    cloth.tint = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(0.6, 0.85)));
    drape_.rectangle(where, cloth);
    cloth.lift_m += 0.001;
    cloth.tint = Eigen::Vector3f::Constant(0.1f);
    cloth.contrast = 0.0;
    constexpr int kSlots = 7;
    for (int i = 0; i < kSlots; ++i) {
      const double at_m = 0.44 * ((i + 0.5) / kSlots - 0.5);
      drape_.rectangle({where.at(at_m, 0.0), forward, 0.019, 0.14}, cloth);
    }
  }

 private:
  static Eigen::Vector2d corner(const Eigen::Vector2d& middle, const Eigen::Vector2d& forward) {
    return middle - 0.5 * kLidPeriod_m * (forward + Eigen::Vector2d(-forward.y(), forward.x()));
  }

  const Site& site_;
  Drape& drape_;
  Cloth iron_, frame_;
  std::uint16_t concrete_;
};

}  // namespace

void lay_covers(const Site& site, const GroundZones& zones, Drape& drape) {
  Coverer coverer(site, drape);
  const Random all(site.parameters.seed, "covers");
  for (std::size_t i = 0; i < site.roads.roads.size(); ++i) {
    const int number = static_cast<int>(i);
    const Road& road = site.roads.roads[i];
    const RoadLine line(road.centre_line);
    Random random = all.part(i);
    const double from_m = std::max(zones.mouths_m(number)[0], 1.0),
                 to_m = std::min(zones.mouths_m(number)[1], line.length_m() - 1.0);
    const double half_m = 0.5 * road.width_m;

    const double sewer_m = random.uniform(-1.2, 1.2);  // left of the centre line
    for (double m = from_m + random.uniform(2.0, 20.0); m < to_m - 1.0; m += random.uniform(18.0, 42.0)) {
      coverer.manhole(line.beside(m, sewer_m + random.uniform(-0.2, 0.2)), line.forward(m),
                      random.part(static_cast<std::uint64_t>(m)));
    }
    for (const double sign : {-1.0, 1.0}) {
      for (double m = from_m + random.uniform(0.5, 9.0); m < to_m; m += random.uniform(16.0, 30.0)) {
        coverer.grate(line.beside(m, sign * (half_m - 0.22)), line.forward(m),
                      random.part(1000 + static_cast<std::uint64_t>(m)));
      }
      // water and gas valves in the road, telephone and power in the pavement
      for (double m = from_m + random.uniform(0.0, 20.0); m < to_m; m += random.uniform(12.0, 45.0)) {
        coverer.plate({line.beside(m, sign * (half_m - random.uniform(0.6, 1.6))), line.forward(m), 0.1, 0.08}, 0.0055,
                      random.part(2000 + static_cast<std::uint64_t>(m)));
      }
      const Zone& zone = zones.zone(zones.street_of(number));
      const double from_kerb_m = zone.beside.size() > 2 && zone.beside[0].to_m > 1.0 ? zone.beside[0].to_m + 0.9 : 1.0;
      for (double m = from_m + random.uniform(0.0, 30.0); m < to_m; m += random.uniform(15.0, 50.0)) {
        const double half_length_m = random.uniform(0.2, 0.55);
        coverer.plate(
            {line.beside(m, sign * (half_m + from_kerb_m)), line.forward(m), half_length_m, random.uniform(0.2, 0.3)},
            kKerbHeight_m + 0.004, random.part(3000 + static_cast<std::uint64_t>(m)));
      }
    }
  }
  for (std::size_t i = 0; i < site.roads.junctions.size(); ++i) {
    if (!zones.has_crossing(static_cast<int>(i))) continue;
    Random random = all.part(5000 + i);
    for (int k = 1 + random.below(3); k > 0; --k) {
      const Eigen::Vector2d point =
          site.roads.junctions[i].position + Eigen::Vector2d(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0));
      const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
      if (site.kerbs->distance_m(point) < -0.9)
        coverer.manhole(point, {std::cos(angle), std::sin(angle)}, random.part(static_cast<std::uint64_t>(k)));
    }
  }
}

}  // namespace panvo::simulated_world

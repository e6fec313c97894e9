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

class RoadMender {
 public:
  RoadMender(const Site& site, Drape& drape) : site_(site), drape_(drape) {
    patch_.material = site.palette->find("asphalt_patch");
    old_patch_.material = site.palette->find("asphalt");
    tar_.material = patch_.material;
    tar_.contrast = 0.35;
    tar_.lift_m = 0.003;
  }

  /// Adds a filled hole or trench. Higher `layer`s lie on lower ones.
  void fill(const Rectangle& where, int layer, Random random) {
    if (is_bare(site_, where.middle)) return;
    const bool is_new = random.chance(0.6);
    Cloth cloth = is_new ? patch_ : old_patch_;
    const auto shade = static_cast<float>(is_new ? random.uniform(0.75, 1.0) : random.uniform(0.55, 1.0));
    cloth.tint = shade * Eigen::Vector3f(1.0f, 0.99f, static_cast<float>(random.uniform(0.94, 1.0)));
    cloth.lift_m = 0.0015 + 0.00025 * layer;
    cloth.origin = where.middle + Eigen::Vector2d(random.uniform(0.0, 3.0), random.uniform(0.0, 3.0));
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    cloth.forward = {std::cos(angle), std::sin(angle)};
    drape_.ragged(where, random.uniform(0.008, 0.03), cloth, random.part(0));
    if (random.chance(0.45)) seal(where, random.part(1));
  }

  /// Adds a crack or joint filled with tar, from `start` to a kerb or to `length_m`.
  void crack(const Eigen::Vector2d& start, double heading_rad, double length_m, double waver_rad, double width_m,
             Random random, int branches) {
    constexpr double kStep_m = 0.16;
    std::vector<Eigen::Vector2d> line{start};
    double heading = heading_rad;
    for (double m = 0.0; m < length_m; m += kStep_m) {
      // random heading that returns to the main direction
      heading += waver_rad * random.gaussian() - 0.15 * std::remainder(heading - heading_rad, 2.0 * std::numbers::pi);
      const Eigen::Vector2d next = line.back() + kStep_m * Eigen::Vector2d(std::cos(heading), std::sin(heading));
      if (site_.kerbs->distance_m(next) > -0.1 || is_bare(site_, next)) break;
      line.push_back(next);
      if (branches > 0 && random.chance(0.025)) {
        --branches;
        crack(next, heading + (random.chance(0.5) ? 0.9 : -0.9), random.uniform(0.6, 2.5), waver_rad, 0.8 * width_m,
              random.part(static_cast<std::uint64_t>(branches)), 0);
      }
    }
    tar_.tint = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(0.3, 0.6)));
    drape_.thread(line, width_m, tar_, random.part(99));
  }

 private:
  // Adds a band of tar around a patch.
  void seal(const Rectangle& where, Random random) {
    tar_.tint = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(0.35, 0.65)));
    const double a = where.half_length_m, b = where.half_width_m;
    const std::array<Eigen::Vector2d, 5> corners{Eigen::Vector2d(-a, -b), {a, -b}, {a, b}, {-a, b}, {-a, -b}};
    const double width_m = random.uniform(0.05, 0.10);
    for (std::size_t i = 0; i < 4; ++i) {
      const double length_m = (corners[i + 1] - corners[i]).norm();
      const int steps = std::max(2, static_cast<int>(length_m / 0.4));
      std::vector<Eigen::Vector2d> line;
      for (int k = 0; k <= steps; ++k) {
        const Eigen::Vector2d at = corners[i] + (corners[i + 1] - corners[i]) * k / steps;
        line.push_back(where.at(at.x() + random.uniform(-0.012, 0.012), at.y() + random.uniform(-0.012, 0.012)));
      }
      drape_.thread(line, width_m, tar_, random.part(i));
    }
  }

  const Site& site_;
  Drape& drape_;
  Cloth patch_, old_patch_, tar_;
};

/// The part of a road between its crossings.
struct Stretch {
  RoadLine line;
  double from_m, to_m;  ///< along the line
  double half_m;        ///< width of the asphalt left and right of the line

  double length_m() const { return to_m - from_m; }
  double heading(double along_m) const {
    const Eigen::Vector2d way = line.forward(along_m);
    return std::atan2(way.y(), way.x());
  }
};

void fill_stretch(const Stretch& stretch, double damage, RoadMender& mender, Random& random) {
  const auto& [line, from_m, to_m, half_m] = stretch;
  const int fills = static_cast<int>(std::lround(damage * stretch.length_m() / 11.0 + random.uniform(0.0, 1.5)));
  for (int i = 0; i < fills; ++i) {
    const double kind = random.uniform();
    Rectangle where;
    if (kind < 0.3) {  // a trench across the whole road or one lane
      const double along_m = random.uniform(from_m + 1.0, to_m - 1.0);
      const double lane = random.uniform() < 0.5 ? 0.0 : random.chance(0.5) ? 0.5 : -0.5;
      where.middle = line.beside(along_m, lane * half_m);
      const Eigen::Vector2d way = line.forward(along_m);
      const double skew = random.gaussian() * 0.06;
      where.forward = (Eigen::Vector2d(-way.y(), way.x()) + skew * way).normalized();
      where.half_length_m = lane == 0.0 ? half_m : 0.5 * half_m;
      where.half_width_m = random.uniform(0.25, 0.8);
      mender.fill(where, i % 5, random.part(static_cast<std::uint64_t>(i)));
    } else if (kind < 0.5) {  // a trench along the road, in pieces that follow it
      const double trench_m = std::min(random.uniform(5.0, 28.0), stretch.length_m() - 2.0);
      const double start_m = random.uniform(from_m + 1.0, to_m - trench_m - 0.5);
      const double half_width_m = random.uniform(0.3, 0.75);
      const double side_m = random.uniform(-half_m + half_width_m, half_m - half_width_m);
      const int pieces = std::max(1, static_cast<int>(trench_m / 5.0));
      for (int k = 0; k < pieces; ++k) {
        const double along_m = start_m + trench_m * (k + 0.5) / pieces;
        where = {line.beside(along_m, side_m), line.forward(along_m), 0.5 * trench_m / pieces, half_width_m};
        // the same layer and random numbers for all pieces: one filling
        mender.fill(where, i % 5, random.part(static_cast<std::uint64_t>(i)));
      }
    } else {  // a hole
      const double along_m = random.uniform(from_m + 1.0, to_m - 1.0);
      where.forward = line.forward(along_m);
      where.half_length_m = random.uniform(0.3, 1.6);
      where.half_width_m = std::min(random.uniform(0.25, 1.1), 0.5 * half_m);
      where.middle = line.beside(along_m, random.uniform(-half_m + where.half_width_m, half_m - where.half_width_m));
      mender.fill(where, i % 5, random.part(static_cast<std::uint64_t>(i)));
    }
  }
}

void crack_stretch(const Stretch& stretch, double damage, RoadMender& mender, Random& random) {
  const auto& [line, from_m, to_m, half_m] = stretch;
  const int cracks = static_cast<int>(std::lround(damage * stretch.length_m() / 7.0));
  for (int i = 0; i < cracks; ++i) {
    const double along_m = random.uniform(from_m, to_m), side_m = random.uniform(-half_m, half_m);
    const bool is_across = random.chance(0.6);
    const double way = stretch.heading(along_m) + (is_across            ? (side_m < 0.0 ? 0.5 : -0.5) * std::numbers::pi
                                                   : random.chance(0.5) ? 0.0
                                                                        : std::numbers::pi);
    mender.crack(line.beside(along_m, side_m), way, random.uniform(1.5, is_across ? 6.5 : 12.0), 0.26,
                 random.uniform(0.02, 0.045), random.part(1000 + static_cast<std::uint64_t>(i)), 3);
  }
}

/// Seals the joint between the lanes' asphalt in places.
void seal_joint(const Stretch& stretch, RoadMender& mender, Random& random) {
  const double joint_m = random.uniform(-0.3, 0.3);
  for (double m = stretch.from_m + random.uniform(0.0, 8.0); m < stretch.to_m - 3.0; m += random.uniform(6.0, 22.0)) {
    const double piece_m = std::min(random.uniform(3.0, 12.0), stretch.to_m - m);
    mender.crack(stretch.line.beside(m, joint_m), stretch.heading(m + 0.5 * piece_m), piece_m, 0.04,
                 random.uniform(0.025, 0.05), random.part(2000 + static_cast<std::uint64_t>(m)), 0);
  }
}

void mend_road(const Site& site, const GroundZones& zones, int number, RoadMender& mender, Random random) {
  const Road& road = site.roads.roads[static_cast<std::size_t>(number)];
  const Zone& zone = zones.zone(zones.street_of(number));
  const RoadLine line(road.centre_line);
  const auto [first_m, last_m] = zones.reach_m(number);
  const Stretch stretch{line, std::max(first_m, 0.0), std::min(last_m, line.length_m()),
                        0.5 * road.width_m - (zone.has_gutter ? 0.34 : 0.04)};
  if (stretch.length_m() < 4.0) return;
  fill_stretch(stretch, zone.damage, mender, random);
  crack_stretch(stretch, zone.damage, mender, random);
  if (random.chance(0.6)) seal_joint(stretch, mender, random);
}

void mend_crossing(const Site& site, const GroundZones& zones, int number, RoadMender& mender, Random random) {
  const Junction& junction = site.roads.junctions[static_cast<std::size_t>(number)];
  const double damage = zones.zone(zones.at(junction.position).crossing).damage;
  const int things = static_cast<int>(std::lround(damage * random.uniform(4.0, 9.0)));
  for (int i = 0; i < things; ++i) {
    const Eigen::Vector2d point =
        junction.position + Eigen::Vector2d(random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0));
    const auto& road = site.roads.roads[static_cast<std::size_t>(
        junction.roads[static_cast<std::size_t>(random.below(static_cast<int>(junction.roads.size())))])];
    const RoadLine line(road.centre_line);
    const Eigen::Vector2d way = road.from == number ? line.forward(4.0) : line.forward(line.length_m() - 4.0);
    Rectangle where{point, way, random.uniform(0.4, 2.2), random.uniform(0.3, 0.9)};
    const double reach_m = std::hypot(where.half_length_m, where.half_width_m);
    if (site.kerbs->distance_m(point) > -reach_m - 0.1) continue;
    if (random.chance(0.6)) {
      mender.fill(where, i % 5, random.part(static_cast<std::uint64_t>(i)));
    } else {
      mender.crack(point, random.uniform(-std::numbers::pi, std::numbers::pi), random.uniform(3.0, 10.0), 0.2,
                   random.uniform(0.02, 0.045), random.part(static_cast<std::uint64_t>(i)), 3);
    }
  }
}

}  // namespace

void lay_repairs(const Site& site, const GroundZones& zones, Drape& drape) {
  RoadMender mender(site, drape);
  const Random random(site.parameters.seed, "road repairs");
  for (std::size_t i = 0; i < site.roads.roads.size(); ++i) {
    mend_road(site, zones, static_cast<int>(i), mender, random.part(i));
  }
  for (std::size_t i = 0; i < site.roads.junctions.size(); ++i) {
    if (zones.has_crossing(static_cast<int>(i)))
      mend_crossing(site, zones, static_cast<int>(i), mender, random.part(1000 + i));
  }
}

}  // namespace panvo::simulated_world

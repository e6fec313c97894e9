// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "ground_parts.hpp"
#include "panvo/simulated_world/random.hpp"
#include "road_line.hpp"

namespace panvo::simulated_world {
namespace {

constexpr double kLineWidth_m = 0.12;

class Marker {
 public:
  Marker(const Site& site, const GroundZones& zones, Drape& drape)
      : site_(site), zones_(zones), drape_(drape), random_(site.parameters.seed, "markings") {
    paint_.material = site.palette->find("marking");
    paint_.lift_m = 0.0035;
  }

  void mark_road(int number) {
    const Road& road = site_.roads.roads[static_cast<std::size_t>(number)];
    const Zone& zone = zones_.zone(zones_.street_of(number));
    const RoadLine line(road.centre_line);
    Random random = random_.part(static_cast<std::uint64_t>(number));
    // equally old along a street
    Random age = random_.part(5000 + static_cast<std::uint64_t>(zones_.street_of(number)));
    const double brightness = age.uniform(0.72, 1.0);
    paint_.tint = {static_cast<float>(brightness), static_cast<float>(brightness),
                   static_cast<float>(brightness * 0.97)};

    std::array<double, 2> reach = zones_.mouths_m(number);
    const bool starts_at_crossing = zones_.has_crossing(road.from), ends_at_crossing = zones_.has_crossing(road.to);
    // the end of an arm takes several metres at each crossing
    if (starts_at_crossing) reach[0] = mark_arm(road, line, zone, reach[0], 1.0, random.part(1));
    if (ends_at_crossing) reach[1] = mark_arm(road, line, zone, reach[1], -1.0, random.part(2));
    if (!starts_at_crossing) reach[0] = 0.0;
    if (!ends_at_crossing) reach[1] = line.length_m();

    mark_centre(line, zone.centre_line, reach);
    const double edge_m = 0.5 * road.width_m - 0.4;
    if (zone.has_edge_lines) {
      for (const double side_m : {-edge_m, edge_m}) strip(line, reach[0], reach[1], side_m, kLineWidth_m);
    }
    if (zone.has_parking_on_left) mark_bays(line, reach, 0.5 * road.width_m, random.part(3));
    if (zone.has_parking_on_right) mark_bays(line, reach, -0.5 * road.width_m, random.part(4));
  }

 private:
  // Paints a strip along the road, `side_m` left of its centre line.
  void strip(const RoadLine& line, double from_m, double to_m, double side_m, double width_m) {
    if (to_m <= from_m) return;
    const int steps = std::max(1, static_cast<int>(std::ceil(to_m - from_m)));
    std::vector<Eigen::Vector2d> right, left;
    const auto lay = [&] {
      if (right.size() > 1) {
        paint_.origin = right.front();
        paint_.forward = (right.back() - right.front()).normalized();
        drape_.ribbon(right, left, paint_);
      }
      right.clear();
      left.clear();
    };
    for (int i = 0; i <= steps; ++i) {
      const double along_m = from_m + (to_m - from_m) * i / steps;
      right.push_back(line.beside(along_m, side_m - 0.5 * width_m));
      left.push_back(line.beside(along_m, side_m + 0.5 * width_m));
      if (is_bare(site_, right.back())) {
        right.pop_back();
        left.pop_back();
        lay();
      }
    }
    lay();
  }

  void box(const RoadLine& line, double along_m, double side_m, double length_m, double width_m) {
    const Eigen::Vector2d middle = line.beside(along_m, side_m);
    if (is_bare(site_, middle)) return;
    paint_.origin = middle;
    paint_.forward = line.forward(along_m);
    drape_.rectangle({middle, paint_.forward, 0.5 * length_m, 0.5 * width_m}, paint_);
  }

  void mark_centre(const RoadLine& line, CentreLine kind, const std::array<double, 2>& reach) {
    if (kind == CentreLine::kNone) return;
    if (kind == CentreLine::kDouble) {
      strip(line, reach[0], reach[1], 0.12, 0.1);
      strip(line, reach[0], reach[1], -0.12, 0.1);
      return;
    }
    const double dash_m = kind == CentreLine::kDashed ? 3.0 : 4.0, gap_m = kind == CentreLine::kDashed ? 5.0 : 2.5;
    for (double along_m = reach[0]; along_m < reach[1] - 1.0; along_m += dash_m + gap_m) {
      strip(line, along_m, std::min(along_m + dash_m, reach[1]), 0.0, kLineWidth_m);
    }
  }

  // Paints the markings where a road meets a crossing at `mouth_m`; `inwards`: sign of the direction into the street.
  // Cars keep right, so cars approaching the crossing are on the left when looking into the street. Returns the
  // position at which the street's own lines start.
  double mark_arm(const Road& road, const RoadLine& line, const Zone& zone, double mouth_m, double inwards,
                  Random random) {
    const double half_m = 0.5 * road.width_m;
    double at_m = mouth_m + 0.4 * inwards;
    const double choice = random.uniform();
    const bool has_zebra = random.chance(0.33);
    if (has_zebra) {
      constexpr double kLength_m = 3.2;
      for (double side_m = -half_m + 0.5; side_m < half_m - 0.2; side_m += 1.0) {
        box(line, at_m + 0.5 * kLength_m * inwards, side_m, kLength_m, 0.5);
      }
      at_m += (kLength_m + 1.0) * inwards;
    }
    const double lane_from_m = 0.12, lane_to_m = half_m - 0.35;
    const double lane_middle_m = 0.5 * (lane_from_m + lane_to_m) * inwards;
    if (choice < 0.38) {
      box(line, at_m + 0.25 * inwards, lane_middle_m, 0.5, lane_to_m - lane_from_m);
      at_m += 0.5 * inwards;
    } else if (choice < 0.75) {
      for (double side_m = lane_from_m + 0.25; side_m < lane_to_m; side_m += 0.75) {
        box(line, at_m + 0.15 * inwards, side_m * inwards, 0.3, 0.5);
      }
      at_m += 0.3 * inwards;
    }
    if (choice < 0.75 && zone.centre_line != CentreLine::kNone) {
      strip(line, std::min(at_m, at_m + 9.0 * inwards), std::max(at_m, at_m + 9.0 * inwards), 0.0, kLineWidth_m);
      if (random.chance(0.5)) arrow(line, at_m + 4.0 * inwards, lane_middle_m, inwards, random.below(4));
      at_m += 11.0 * inwards;
    }
    if (random.chance(0.22) && !zone.has_parking_on_left && !zone.has_parking_on_right) {
      limit(line, at_m + 5.0 * inwards, -lane_middle_m, inwards);
    }
    return at_m + 0.5 * inwards;
  }

  // Paints a polygon in the driver's frame: x towards the crossing, y left.
  void shape(const RoadLine& line, double along_m, double side_m, double inwards,
             const std::vector<Eigen::Vector2d>& outline) {
    const Eigen::Vector2d middle = line.beside(along_m, side_m);
    if (is_bare(site_, middle)) return;
    const Eigen::Vector2d forward = -inwards * line.forward(along_m);
    const Rectangle frame{middle, forward, 0.0, 0.0};
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector2d& corner : outline) points.push_back(frame.at(corner.x(), corner.y()));
    paint_.origin = middle;
    paint_.forward = forward;
    drape_.polygon(points, paint_);
  }

  void arrow(const RoadLine& line, double along_m, double side_m, double inwards, int kind) {
    const auto add = [&](const std::vector<Eigen::Vector2d>& outline) {
      shape(line, along_m, side_m, inwards, outline);
    };
    add({{-2.2, -0.08}, {0.6, -0.08}, {0.6, 0.08}, {-2.2, 0.08}});
    if (kind == 0 || kind == 3) {  // straight on
      add({{0.6, -0.08}, {1.1, -0.08}, {1.1, 0.08}, {0.6, 0.08}});
      add({{1.1, -0.32}, {2.4, 0.0}, {1.1, 0.32}});
    }
    const auto turn = [&](double left) {
      const auto bend = [&](std::vector<Eigen::Vector2d> corners) {
        for (Eigen::Vector2d& corner : corners) corner.y() *= left;
        if (left < 0.0) std::reverse(corners.begin(), corners.end());
        add(corners);
      };
      bend({{0.3, 0.05}, {0.75, 0.05}, {1.35, 0.5}, {1.0, 0.5}});
      bend({{0.6, 0.5}, {1.75, 0.5}, {1.3, 1.1}});
    };
    if (kind == 1 || kind == 3) turn(-1.0);
    if (kind == 2) turn(1.0);
  }

  // Paints "30", elongated for drivers.
  void limit(const RoadLine& line, double along_m, double side_m, double inwards) {
    const auto bar = [&](double x, double y, double length_m, double width_m) {
      shape(line, along_m, side_m, -inwards,
            {{x - 0.5 * length_m, y - 0.5 * width_m},
             {x + 0.5 * length_m, y - 0.5 * width_m},
             {x + 0.5 * length_m, y + 0.5 * width_m},
             {x - 0.5 * length_m, y + 0.5 * width_m}});
    };
    constexpr double kHalf_m = 1.7;
    for (const double x : {-kHalf_m + 0.15, 0.0, kHalf_m - 0.15}) bar(x, 0.5, 0.3, 0.4);  // 3
    bar(0.0, 0.23, 2.0 * kHalf_m, 0.14);
    for (const double y : {-0.24, -0.76}) bar(0.0, y, 2.0 * kHalf_m, 0.14);  // 0
    for (const double x : {-kHalf_m + 0.15, kHalf_m - 0.15}) bar(x, -0.5, 0.3, 0.38);
  }

  void mark_bays(const RoadLine& line, const std::array<double, 2>& reach, double kerb_m, Random random) {
    constexpr double kDepth_m = 2.0, kBay_m = 5.6;
    const double inner_m = kerb_m > 0.0 ? kerb_m - kDepth_m : kerb_m + kDepth_m;
    const double middle_m = kerb_m > 0.0 ? kerb_m - 0.5 * kDepth_m - 0.1 : kerb_m + 0.5 * kDepth_m + 0.1;
    const double from_m = reach[0] + random.uniform(4.0, 10.0);
    const int bays = static_cast<int>((reach[1] - random.uniform(4.0, 10.0) - from_m) / kBay_m);
    for (int i = 0; i <= bays; ++i) {
      const double along_m = from_m + i * kBay_m;
      box(line, along_m, middle_m, 0.1, kDepth_m - 0.2);
      box(line, along_m, inner_m, 1.2, 0.1);  // corners only
    }
  }

  const Site& site_;
  const GroundZones& zones_;
  Drape& drape_;
  Random random_;
  Cloth paint_;
};

}  // namespace

void lay_markings(const Site& site, const GroundZones& zones, Drape& drape) {
  Marker marker(site, zones, drape);
  for (std::size_t road = 0; road < site.roads.roads.size(); ++road) marker.mark_road(static_cast<int>(road));
}

}  // namespace panvo::simulated_world

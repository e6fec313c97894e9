// SPDX-License-Identifier: Apache-2.0
// Converts a route to the vehicle's path: right-hand lanes, connected by arcs at the junctions, all smoothed.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "panvo/simulation/route.hpp"
#include "route_legs.hpp"

namespace panvo::simulation {

using simulated_world::RoadNetwork;

namespace {

using Eigen::Vector2d;

constexpr double kStep_m = 0.1;              // between the path's points
constexpr double kMinRadius_m = 5.0;         // of turns
constexpr double kStraight_rad = 0.7;        // smaller changes of direction are driven as a curve
constexpr double kMaxUsed = 0.45;            // fraction of a road that the turn at one end may use
constexpr double kSmoothing_m = 1.2;         // standard deviation: curvature changes over about 4 m
constexpr double kClearOfCrossing_m = 12.0;  // distance of the path's ends from the first and last junction
constexpr double kClearOfEnd_m = 3.0;        // the same in a cul-de-sac

double angle_between(const Vector2d& a, const Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

void add_arc(std::vector<Vector2d>& points, const Vector2d& centre, const Vector2d& from, double angle) {
  const auto steps = static_cast<int>(std::ceil(std::abs(angle) * from.norm() / kStep_m));
  for (int i = 0; i <= steps; ++i) {
    const double turned = angle * i / steps, c = std::cos(turned), s = std::sin(turned);
    points.emplace_back(centre + Vector2d(c * from.x() - s * from.y(), s * from.x() + c * from.y()));
  }
}

// The circle of this radius that touches both lanes on their `side` (+1 left, -1 right); nullopt if there is none
// within reach. Its centre is the intersection of both lanes offset by the radius.
struct Touch {
  Vector2d centre;
  double on_in_m, on_out_m;
};
std::optional<Touch> touching_circle(const Leg& in, const Leg& out, double radius, double side) {
  constexpr double kBeyond_m = 12.0, kStride_m = 0.5;
  const auto moved = [&](const Leg& leg, double along) -> Vector2d {
    return leg.at(along) + side * radius * left_of(leg.way(along));
  };
  const double reach_in = kMaxUsed * in.length_m, reach_out = kMaxUsed * out.length_m;
  std::vector<Vector2d> line_in, line_out;
  for (double back = -kBeyond_m; back < reach_in; back += kStride_m) line_in.push_back(moved(in, in.length_m - back));
  for (double on = -kBeyond_m; on < reach_out; on += kStride_m) line_out.push_back(moved(out, on));
  for (std::size_t i = 0; i + 1 < line_in.size(); ++i) {
    for (std::size_t j = 0; j + 1 < line_out.size(); ++j) {
      const Vector2d a = line_in[i + 1] - line_in[i], b = line_out[j + 1] - line_out[j];
      const Vector2d between = line_out[j] - line_in[i];
      const double cross = a.x() * b.y() - a.y() * b.x();
      if (std::abs(cross) < 1e-9) continue;
      const double u = (between.x() * b.y() - between.y() * b.x()) / cross;
      const double v = (between.x() * a.y() - between.y() * a.x()) / cross;
      if (u < 0.0 || u > 1.0 || v < 0.0 || v > 1.0) continue;
      return Touch{line_in[i] + u * a, in.length_m + kBeyond_m - kStride_m * (static_cast<double>(i) + u),
                   kStride_m * (static_cast<double>(j) + v) - kBeyond_m};
    }
  }
  return std::nullopt;
}

// Almost straight ahead: a cubic from lane to lane.
std::vector<Vector2d> straight_on(Leg& in, Leg& out, double angle) {
  const double blend = angle < 0.0 ? 6.0 : 9.0;  // m; shorter to the right, where the kerb is near
  in.end_m = in.length_m - std::min(blend, kMaxUsed * in.length_m);
  out.begin_m = std::min(blend, kMaxUsed * out.length_m);
  const Vector2d a = in.at(in.end_m), b = out.at(out.begin_m);
  const double length = (b - a).norm();
  const Vector2d at_a = length * in.way(in.end_m), at_b = length * out.way(out.begin_m);
  std::vector<Vector2d> points;
  const auto steps = static_cast<int>(std::ceil(length / kStep_m));
  for (int i = 0; i <= steps; ++i) {
    const double u = static_cast<double>(i) / steps, v = 1.0 - u;
    points.emplace_back(v * v * (1.0 + 2.0 * u) * a + u * u * (3.0 - 2.0 * u) * b + u * v * (v * at_a - u * at_b));
  }
  return points;
}

// An arc through a junction. A right turn follows the rounded kerb closely; a left turn is wider.
std::vector<Vector2d> turn(Leg& in, Leg& out) {
  constexpr double kRightReach_m = 6.0, kLeftReach_m = 8.5, kMaxRadius_m = 16.0;
  const double angle = angle_between(in.way(in.length_m - 5.0), out.way(5.0));
  if (std::abs(angle) < kStraight_rad) return straight_on(in, out, angle);
  const double side = angle > 0.0 ? 1.0 : -1.0;
  const double reach = angle > 0.0 ? kLeftReach_m : kRightReach_m;
  double radius = std::clamp(reach / std::tan(std::abs(angle) / 2.0), kMinRadius_m, kMaxRadius_m);
  std::optional<Touch> touch;
  while (!(touch = touching_circle(in, out, radius, side)) && radius > kMinRadius_m) {
    radius = std::max(0.9 * radius, kMinRadius_m);
  }
  if (!touch) return straight_on(in, out, angle);
  in.end_m = touch->on_in_m;
  out.begin_m = touch->on_out_m;
  const Vector2d from = in.at(in.end_m) - touch->centre, to = out.at(out.begin_m) - touch->centre;
  double swept = angle_between(from, to);
  if (side * swept < 0.0) swept += side * 2.0 * std::numbers::pi;
  std::vector<Vector2d> points;
  add_arc(points, touch->centre, from, swept);
  return points;
}

// A U-turn at the end of a cul-de-sac: an arc to the right, most of a circle to the left, an arc to the right.
std::vector<Vector2d> turn_back(Leg& in, Leg& out) {
  constexpr double kCircle_m = 5.2, kSwing_m = 8.0;
  const double from_axis = in.offset_m + kSwing_m, both = kCircle_m + kSwing_m;
  const double before = std::sqrt(both * both - from_axis * from_axis);
  const double swing = std::acos(from_axis / both);
  in.end_m = in.length_m - before;
  out.begin_m = before;
  const Vector2d way = in.way(in.end_m), left = left_of(way);
  const Vector2d centre = in.at(in.end_m) + before * way + in.offset_m * left;
  const Vector2d right_centre = centre - before * way - from_axis * left;
  const Vector2d left_centre = centre - before * way + from_axis * left;
  std::vector<Vector2d> points;
  add_arc(points, right_centre, kSwing_m * left, -swing);
  add_arc(points, centre, (right_centre - centre).normalized() * kCircle_m, std::numbers::pi + 2.0 * swing);
  add_arc(points, left_centre, (centre - left_centre).normalized() * kSwing_m, -swing);
  return points;
}

// Points at equal distances of about kStep_m on the line through `points`.
std::vector<Vector2d> evenly(const std::vector<Vector2d>& points) {
  std::vector<double> along(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) along[i] = along[i - 1] + (points[i] - points[i - 1]).norm();
  const auto steps = static_cast<std::size_t>(std::ceil(along.back() / kStep_m));
  std::vector<Vector2d> even;
  std::size_t j = 1;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double at = along.back() * static_cast<double>(k) / static_cast<double>(steps);
    while (j + 1 < along.size() && along[j] < at) ++j;
    const double length = along[j] - along[j - 1];
    const double share = length > 0.0 ? (at - along[j - 1]) / length : 0.0;
    even.emplace_back(points[j - 1] + share * (points[j] - points[j - 1]));
  }
  return even;
}

void keep_left(Leg& leg, double left_m) {
  leg.offset_m -= left_m;
  for (std::size_t i = 0; i < leg.lane.size(); ++i) leg.lane[i] += left_m * left_of(leg.ways[i]);
}

// Convolution with a Gaussian; the line is extended at both ends by its point reflection.
std::vector<Vector2d> smoothed(const std::vector<Vector2d>& points) {
  const auto reach = static_cast<int>(std::ceil(4.0 * kSmoothing_m / kStep_m));
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * std::pow(k * kStep_m / kSmoothing_m, 2)));
    sum += weights.back();
  }
  const auto last = static_cast<int>(points.size()) - 1;
  const auto at = [&](int i) -> Vector2d {
    const auto point = [&](int k) { return points[static_cast<std::size_t>(std::clamp(k, 0, last))]; };
    if (i < 0) return 2.0 * points.front() - point(-i);
    if (i > last) return 2.0 * points.back() - point(2 * last - i);
    return point(i);
  };
  std::vector<Vector2d> smooth;
  for (int i = 0; i <= last; ++i) {
    Vector2d mean = Vector2d::Zero();
    for (int k = -reach; k <= reach; ++k) mean += weights[static_cast<std::size_t>(k + reach)] / sum * at(i + k);
    smooth.push_back(mean);
  }
  return smooth;
}

// How the vehicle gets from one leg to the next: lines, of which the first one continues the leg before and the last one
// is continued by the leg after. Where one line ends and the next begins, it turns in place.
using Joint = std::vector<std::vector<Vector2d>>;

Joint join_as_car(Leg& in, Leg& out, bool is_end) { return {is_end ? turn_back(in, out) : turn(in, out)}; }

// Turns where both lanes meet; at the end of a cul-de-sac it crosses the road to the other lane.
Joint join_turning_in_place(Leg& in, Leg& out, bool is_end) {
  if (is_end) {
    out.begin_m = std::min(kClearOfEnd_m, kMaxUsed * out.length_m);
    in.end_m = in.length_m - out.begin_m;
    const Vector2d here = in.at(in.end_m), there = out.at(out.begin_m);
    return {{here}, {here, there}, {there}};
  }
  const double angle = angle_between(in.way(in.length_m - 5.0), out.way(5.0));
  const auto meeting = std::abs(angle) < kStraight_rad ? std::nullopt : touching_circle(in, out, 0.0, 1.0);
  if (!meeting) return {straight_on(in, out, angle)};
  in.end_m = meeting->on_in_m;
  out.begin_m = meeting->on_out_m;
  return {{meeting->centre}, {meeting->centre}};
}

std::vector<std::vector<Vector2d>> lines_of(const RoadNetwork& roads, std::vector<Leg> legs, Steering steering) {
  const auto is_end = [&](int junction) {
    return roads.junctions[static_cast<std::size_t>(junction)].roads.size() == 1;
  };
  std::vector<Joint> joints;
  for (std::size_t i = 0; i + 1 < legs.size(); ++i) {
    const auto join = steering == Steering::kCar ? join_as_car : join_turning_in_place;
    joints.push_back(join(legs[i], legs[i + 1], is_end(legs[i].to)));
  }
  const auto clear_of = [&](int junction, double length) {
    return std::min(is_end(junction) ? kClearOfEnd_m : kClearOfCrossing_m, kMaxUsed * length);
  };
  legs.front().begin_m = clear_of(legs.front().from, legs.front().length_m);
  legs.back().end_m = legs.back().length_m - clear_of(legs.back().to, legs.back().length_m);

  std::vector<std::vector<Vector2d>> lines(1);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    auto along = legs[i].begin_m;
    // the point where it turned is the line's first one already
    if (i > 0 && joints[i - 1].size() > 1) along += kStep_m;
    for (; along < legs[i].end_m; along += kStep_m) lines.back().push_back(legs[i].at(along));
    if (i == joints.size()) break;
    lines.back().insert(lines.back().end(), joints[i].front().begin(), joints[i].front().end());
    lines.insert(lines.end(), joints[i].begin() + 1, joints[i].end());
  }
  lines.back().push_back(legs.back().at(legs.back().end_m));
  return lines;
}

// Appends a line of evenly spaced points, the first of which is the last one of the line before.
void append(const std::vector<Vector2d>& points, DrivenPath& path) {
  const std::size_t begin = path.points.empty() ? 0 : path.points.size() - 1;
  if (!path.points.empty()) {
    path.turns_in_place.push_back(begin);
    path.points.pop_back();
  }
  path.points.insert(path.points.end(), points.begin(), points.end());
  const std::size_t count = path.points.size();
  path.along_m.resize(count, 0.0);
  path.curvature_per_m.resize(count, 0.0);
  for (std::size_t i = begin + 1; i < count; ++i) {
    path.along_m[i] = path.along_m[i - 1] + (path.points[i] - path.points[i - 1]).norm();
  }
  // from points two steps away: with single steps, rounding errors would be visible
  constexpr std::size_t kApart = 2;
  for (std::size_t i = begin + kApart; i + kApart < count; ++i) {
    const Vector2d before = path.points[i] - path.points[i - kApart], after = path.points[i + kApart] - path.points[i];
    path.curvature_per_m[i] = 2.0 * angle_between(before, after) / (before.norm() + after.norm());
  }
}

}  // namespace

DrivenPath drive(const RoadNetwork& roads, const Route& route, double left_m, Steering steering) {
  std::vector<Leg> legs = legs_of(roads, route);
  for (auto& leg : legs) keep_left(leg, left_m);
  DrivenPath path;
  for (const auto& line : lines_of(roads, std::move(legs), steering)) append(evenly(smoothed(evenly(line))), path);
  return path;
}

}  // namespace panvo::simulation

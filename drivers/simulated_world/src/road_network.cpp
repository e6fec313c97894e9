// SPDX-License-Identifier: Apache-2.0
#include "panvo/simulated_world/road_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace panvo::simulated_world {

namespace {

// Direction of a road as it leaves the junction, in [0, 2 pi), measured several metres away from it.
double leaving_angle(const Road& road, bool at_its_start) {
  const auto& line = road.centre_line;
  const std::size_t out = std::min<std::size_t>(line.size() - 1, 5);
  const Eigen::Vector2d way =
      at_its_start ? Eigen::Vector2d(line[out] - line[0]) : Eigen::Vector2d(line[line.size() - 1 - out] - line.back());
  const double angle = std::atan2(way.y(), way.x());
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

// Updates `best` with the nearest point of one road. The distance to a centre line changes by at most a metre per metre
// along it, so that distant points allow long steps.
void search_road(const Road& road, int number, const Eigen::Vector2d& point, RoadNetwork::Nearest& best) {
  const auto& line = road.centre_line;
  double along = 0.0;
  std::size_t i = 0;
  while (i + 1 < line.size()) {
    const double to_point = (point - line[i]).norm();
    if (road.max_step_m > 0.0) {
      const double to_spare = (to_point - best.distance_m) / road.max_step_m - 1.0;
      if (to_spare >= 1.0) {
        i += static_cast<std::size_t>(std::min(to_spare, static_cast<double>(line.size())));
        along = -1.0;
        continue;
      }
    }
    const Eigen::Vector2d step = line[i + 1] - line[i];
    const double length = step.norm();
    if (length > 0.0) {
      const Eigen::Vector2d from_start = point - line[i];
      const double share = std::clamp(from_start.dot(step) / (length * length), 0.0, 1.0);
      const double distance = (from_start - share * step).norm();
      if (distance < best.distance_m) {
        if (along < 0.0) {
          along = 0.0;
          for (std::size_t j = 0; j < i; ++j) along += (line[j + 1] - line[j]).norm();
        }
        const double side = step.x() * from_start.y() - step.y() * from_start.x();
        best = {distance, along + share * length, std::copysign(distance, side), number};
      }
      if (along >= 0.0) along += length;
    }
    ++i;
  }
}

}  // namespace

std::optional<int> RoadNetwork::find(std::string_view junction_name) const {
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    if (junctions[i].name == junction_name) return static_cast<int>(i);
  }
  return std::nullopt;
}

void RoadNetwork::join() {
  std::vector<std::vector<std::pair<double, int>>> arms(junctions.size());
  for (std::size_t i = 0; i < roads.size(); ++i) {
    const Road& road = roads[i];
    arms[static_cast<std::size_t>(road.from)].emplace_back(leaving_angle(road, true), static_cast<int>(i));
    arms[static_cast<std::size_t>(road.to)].emplace_back(leaving_angle(road, false), static_cast<int>(i));
  }
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    std::sort(arms[i].begin(), arms[i].end());
    junctions[i].roads.clear();
    for (const auto& [angle, road] : arms[i]) junctions[i].roads.push_back(road);
  }
}

RoadNetwork::Nearest RoadNetwork::nearest_road(const Eigen::Vector2d& point) const {
  Nearest best;
  best.distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < roads.size(); ++i) search_road(roads[i], static_cast<int>(i), point, best);
  return best;
}

}  // namespace panvo::simulated_world

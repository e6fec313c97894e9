// SPDX-License-Identifier: Apache-2.0
#include "panvo/fleet/common_frame.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <tuple>

namespace panvo::fleet {
namespace {

MapTransform identity() { return {Eigen::Isometry3d::Identity(), vision::Matrix6d::Zero()}; }

/// Poses of all maps that joins connect with `start`, in the frame of `start`. The joins form no loop.
std::map<MapId, MapTransform> connected_with(MapId start, const std::vector<JoinedPair>& joins) {
  std::map<MapId, MapTransform> start_from{{start, identity()}};
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    for (const auto& join : joins) {
      const auto a = start_from.find(join.a), b = start_from.find(join.b);
      if ((a == start_from.end()) == (b == start_from.end())) continue;
      has_grown = true;
      if (a != start_from.end()) {
        start_from[join.b] = a->second * join.transform;
      } else {
        start_from[join.a] = b->second * inverse(join.transform);
      }
    }
  }
  return start_from;
}

bool agrees(const MapTransform& around, const MapTransform& direct, double gate_chi_square) {
  const auto error = vision::pose_error(around.a_from_b, direct.a_from_b);
  const vision::Matrix6d covariance = around.covariance + direct.covariance;
  return error.dot(covariance.ldlt().solve(error)) < gate_chi_square;
}

/// The map that most of the joined present robots use, of those that are joined and present themselves.
MapId most_used(MapId own, const std::map<MapId, MapTransform>& own_from, const std::map<MapId, MapId>& used) {
  std::map<MapId, int> count{{own, 0}};
  for (const auto& [map, transform] : own_from) {
    if (used.contains(map)) count[map] = 0;
  }
  for (const auto& [user, map] : used) {
    if (count.contains(user) && count.contains(map)) ++count[map];
  }
  auto best = count.begin();
  for (auto one = count.begin(); one != count.end(); ++one) {
    if (one->second > best->second) best = one;
  }
  return best->first;
}

}  // namespace

MapTransform operator*(const MapTransform& a_from_b, const MapTransform& b_from_c) {
  return {a_from_b.a_from_b * b_from_c.a_from_b,
          vision::compose_covariance(a_from_b.a_from_b, a_from_b.covariance, b_from_c.a_from_b, b_from_c.covariance)};
}

MapTransform inverse(const MapTransform& a_from_b) {
  return {a_from_b.a_from_b.inverse(), vision::invert_covariance(a_from_b.a_from_b, a_from_b.covariance)};
}

CommonFrame common_frame(MapId own, std::vector<JoinedPair> joins, const std::map<MapId, MapId>& used,
                         double gate_chi_square) {
  std::sort(joins.begin(), joins.end(), [](const JoinedPair& one, const JoinedPair& two) {
    return std::tuple(-one.agreeing, one.a, one.b) < std::tuple(-two.agreeing, two.a, two.b);
  });
  CommonFrame frame{own, identity(), {}, {}};
  std::vector<JoinedPair> tree;
  for (const auto& join : joins) {
    const auto reached = connected_with(join.a, tree);
    const auto around = reached.find(join.b);
    if (around == reached.end()) {
      tree.push_back(join);
    } else if (!agrees(around->second, join.transform, gate_chi_square)) {
      frame.contradictory.emplace_back(join.a, join.b);
    }
  }
  frame.own_from = connected_with(own, tree);
  frame.own_from.erase(own);
  frame.map = most_used(own, frame.own_from, used);
  if (frame.map != own) frame.common_from_own = inverse(frame.own_from.at(frame.map));
  return frame;
}

}  // namespace panvo::fleet

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

}  // namespace

MapTransform operator*(const MapTransform& a_from_b, const MapTransform& b_from_c) {
  return {a_from_b.a_from_b * b_from_c.a_from_b,
          vision::compose_covariance(a_from_b.a_from_b, a_from_b.covariance, b_from_c.a_from_b, b_from_c.covariance)};
}

MapTransform inverse(const MapTransform& a_from_b) {
  return {a_from_b.a_from_b.inverse(), vision::invert_covariance(a_from_b.a_from_b, a_from_b.covariance)};
}

CommonFrame common_frame(MapId own, std::vector<JoinedPair> joins, const std::set<MapId>& present,
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
  for (const auto& [map, own_from_map] : frame.own_from) {
    if (map < frame.map && present.contains(map)) frame.map = map;
  }
  if (frame.map != own) frame.common_from_own = inverse(frame.own_from.at(frame.map));
  return frame;
}

}  // namespace panvo::fleet

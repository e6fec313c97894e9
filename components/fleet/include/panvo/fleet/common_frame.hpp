// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "panvo/fleet/map_join.hpp"

namespace panvo::fleet {

/// Two joined maps.
struct JoinedPair {
  MapId a = 0, b = 0;
  MapTransform transform;  ///< a_from_b
  int agreeing = 0;        ///< sightings
};

/// The frame that joined maps share: that of one of them.
struct CommonFrame {
  MapId map = 0;
  MapTransform common_from_own;
  std::map<MapId, MapTransform> own_from;              ///< of each joined map, without the own one
  std::vector<std::pair<MapId, MapId>> contradictory;  ///< joins left out: they contradict stronger ones around a loop
};

/// The frame of the maps that are joined with `own`, directly or through others. `used`: for each map whose robot is
/// present, also the own one, the map whose frame that robot uses now. The frame is that of the present map which most of
/// the joined robots use, so that a robot that joins a fleet takes over its frame; of several, that with the smallest
/// id. Joins are taken in the order of their sightings; one that closes a loop is only compared: its squared Mahalanobis
/// distance must be below `gate_chi_square`. Deterministic: robots that know the same choose the same frame.
CommonFrame common_frame(MapId own, std::vector<JoinedPair> joins, const std::map<MapId, MapId>& used,
                         double gate_chi_square);

/// a_from_c = a_from_b * b_from_c and a_from_b = b_from_a^-1, with their covariances.
MapTransform operator*(const MapTransform& a_from_b, const MapTransform& b_from_c);
MapTransform inverse(const MapTransform& a_from_b);

}  // namespace panvo::fleet

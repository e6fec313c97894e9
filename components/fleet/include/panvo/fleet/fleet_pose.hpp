// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "panvo/fleet/map_join.hpp"
#include "panvo/fleet/pose_trail.hpp"
#include "panvo/fleet/shared_map.hpp"

namespace panvo::fleet {

/// Two joined maps and their sightings that agree.
struct JoinedMaps {
  const SharedMap* a = nullptr;
  const SharedMap* b = nullptr;
  std::vector<CrossSighting> agreed;
};

/// A relation between a place of one map and a place of another, from the sightings around them. Bridges of two maps
/// share no sightings.
struct Bridge {
  PlaceKey a, b;
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();  ///< base at place a from base at place b
  vision::Matrix6d covariance = vision::Matrix6d::Identity();
};

/// Sightings that are at most `extent_m` from the first one of their group, as one bridge each.
std::vector<Bridge> bridges(const JoinedMaps& joined, double extent_m, const JoinParameters& parameters);

struct FleetPose {
  Eigen::Isometry3d common_from_base = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Identity();  ///< as vision::pose_error
  int bridges = 0;                                             ///< on the way
};

/// The pose of the vehicle in the frame of the map `common`, along the most certain way: from the origin of that map to
/// one of its places, over bridges and through other maps, and back to the own map and the pose `in_own`. Each part
/// adds its uncertainty: of places relative to each other, of bridges. So a map that is certain between two places helps
/// robots whose own map is not, even the one whose map is the common one. nullopt if no way leads there.
std::optional<FleetPose> most_certain_pose(const SharedMap& common, const SharedMap& own, const PoseSample& in_own,
                                           const std::vector<JoinedMaps>& joined, const JoinParameters& parameters);

}  // namespace panvo::fleet

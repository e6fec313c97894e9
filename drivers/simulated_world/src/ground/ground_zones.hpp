// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "panvo/simulated_world/site.hpp"

namespace panvo::simulated_world {

/// A strip of ground along the kerb.
struct Band {
  double to_m = 0.0;  ///< its outer edge, from the kerb
  std::uint16_t material = 0;
  bool follows_road = false;  ///< the texture is aligned with the road: slabs, setts
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();
};

enum class CentreLine { kNone, kDashed, kLongDashed, kDouble };

/// The construction of a street or a crossing.
struct Zone {
  int road = -1;      ///< first road of a street
  int junction = -1;  ///< junction of a crossing
  std::uint16_t asphalt = 0, gutter = 0;
  bool has_gutter = false;  ///< with its own material
  Eigen::Vector3f asphalt_tint = Eigen::Vector3f::Ones();
  float wear = 0.0f;         ///< of the wheel tracks, -1..1: darker or lighter than the rest
  float damage = 0.5f;       ///< 0..1: amount of repairs and cracks
  std::vector<Band> beside;  ///< beyond the top of the kerb; then grass
  Eigen::Vector2d origin = Eigen::Vector2d::Zero(), forward = Eigen::Vector2d::UnitX();  ///< of a crossing's textures
  CentreLine centre_line = CentreLine::kNone;
  bool has_edge_lines = false, has_parking_on_left = false, has_parking_on_right = false;
};

/// Divides the ground into zones. A crossing extends equally far along all its roads, as far as its longest kerb
/// corner.
class GroundZones {
 public:
  explicit GroundZones(const Site& site);

  struct Place {
    int street = 0, crossing = -1;  ///< zones: of the nearest road and of its nearer end
    double into_street_m = 0.0;     ///< along the road from the end of the crossing; negative on the crossing
    /// The same for points beside the road, from the distance to the crossing's centre: continuous where two roads are
    /// equally near.
    double off_crossing_m = 0.0;
    RoadNetwork::Nearest nearest;
  };
  Place at(const Eigen::Vector2d& point) const;

  const Zone& zone(int number) const { return zones_[static_cast<std::size_t>(number)]; }
  int street_of(int road) const { return street_of_[static_cast<std::size_t>(road)]; }
  /// Positions (m) along a road where its street starts and ends. Beyond: a crossing, or another road of the street.
  const std::array<double, 2>& reach_m(int road) const { return reach_m_[static_cast<std::size_t>(road)]; }
  /// Positions (m) along a road between which its kerbs run parallel to it: where vehicles stop before a crossing.
  const std::array<double, 2>& mouths_m(int road) const { return mouths_m_[static_cast<std::size_t>(road)]; }
  bool has_crossing(int junction) const { return crossing_of_[static_cast<std::size_t>(junction)] >= 0; }

 private:
  const Site& site_;
  std::vector<Zone> zones_;
  std::vector<int> street_of_, crossing_of_;  ///< zones; -1: no crossing
  std::vector<std::array<double, 2>> reach_m_, mouths_m_;
};

}  // namespace panvo::simulated_world

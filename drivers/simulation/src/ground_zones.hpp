// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "panvo/simulation/site.hpp"

namespace panvo::simulation {

/// A strip of ground along the kerb.
struct Band {
  double to_m = 0.0;  ///< from the kerb, where the next begins
  std::uint16_t material = 0;
  bool follows_road = false;  ///< the texture runs along the road: slabs, setts
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();
};

enum class CentreLine { kNone, kDashed, kLongDashed, kDouble };

/// How a street, or a crossing, is built.
struct Zone {
  int road = -1;      ///< of a street, its first one
  int junction = -1;  ///< of a crossing
  std::uint16_t asphalt = 0, gutter = 0;
  bool has_gutter = false;  ///< of a material of its own
  Eigen::Vector3f asphalt_tint = Eigen::Vector3f::Ones();
  float wear = 0.0f;         ///< of the wheel tracks, -1..1: darker or lighter than the rest
  float damage = 0.5f;       ///< 0..1: how many repairs and cracks
  std::vector<Band> beside;  ///< beyond the kerb's top; then grass
  Eigen::Vector2d origin = Eigen::Vector2d::Zero(), forward = Eigen::Vector2d::UnitX();  ///< of a crossing's textures
  CentreLine centre_line = CentreLine::kNone;
  bool has_edge_lines = false, has_parking_on_left = false, has_parking_on_right = false;
};

/// Which zone is where. A crossing reaches as far along each of its roads as the longest of its kerbs' corners.
class GroundZones {
 public:
  explicit GroundZones(const Site& site);

  struct Place {
    int street = 0, crossing = -1;  ///< zones: of the nearest road and of its nearer end
    double into_street_m = 0.0;     ///< along the road from where the crossing ends; negative on the crossing
    /// The same beside the road, by the distance from the crossing's middle: even where two roads are equally near.
    double off_crossing_m = 0.0;
    RoadNetwork::Nearest nearest;
  };
  Place at(const Eigen::Vector2d& point) const;

  const Zone& zone(int number) const { return zones_[static_cast<std::size_t>(number)]; }
  int street_of(int road) const { return street_of_[static_cast<std::size_t>(road)]; }
  /// How far (m) along a road its street begins and ends. Beyond: a crossing, or another road of the same street.
  const std::array<double, 2>& reach_m(int road) const { return reach_m_[static_cast<std::size_t>(road)]; }
  /// How far (m) along a road its kerbs begin and end to run beside it: here one stops before a crossing.
  const std::array<double, 2>& mouths_m(int road) const { return mouths_m_[static_cast<std::size_t>(road)]; }
  bool has_crossing(int junction) const { return crossing_of_[static_cast<std::size_t>(junction)] >= 0; }

 private:
  const Site& site_;
  std::vector<Zone> zones_;
  std::vector<int> street_of_, crossing_of_;  ///< zones; -1: no crossing
  std::vector<std::array<double, 2>> reach_m_, mouths_m_;
};

}  // namespace panvo::simulation

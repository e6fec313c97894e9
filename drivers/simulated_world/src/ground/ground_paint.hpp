// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "ground_zones.hpp"
#include "land_noise.hpp"
#include "panvo/simulated_world/mesh.hpp"

namespace panvo::simulated_world {

/// Local tints of the ground: age, dirt, wear, damp.
class GroundPaint {
 public:
  explicit GroundPaint(const Site& site);

  /// Tint of the carriageway in a zone, `kerb_m` from the kerb (negative) and `into_street_m` into the street.
  Tint carriageway(const Eigen::Vector2d& point, double kerb_m, double into_street_m, const Zone& zone) const;
  /// Tint of a band beside the carriageway.
  Tint beside(const Eigen::Vector2d& point, double kerb_m, const Eigen::Vector3f& tint) const;
  Tint grass(const Eigen::Vector2d& point, double kerb_m) const;
  /// Tint of fields beyond the campus; equals grass() at kFieldsBegin_m from the kerb.
  Tint field(const Eigen::Vector2d& point, double kerb_m) const;
  /// Tint of objects laid on the road: `tint` with the local dirt.
  Tint laid(const Eigen::Vector2d& point, const Eigen::Vector3f& tint, double contrast = 1.0) const;

  static constexpr double kFieldsBegin_m = 45.0;

 private:
  double unevenness(const Eigen::Vector2d& point) const;
  Tint tint(const Eigen::Vector2d& point, const Eigen::Vector3f& colour, double contrast = 1.0) const;

  const Site& site_;
  LandNoise fine_, medium_, coarse_, dirt_, field_, field_share_;
  Eigen::Vector3f far_from_grass_;  ///< tint that makes the distant land material look like grass
};

}  // namespace panvo::simulated_world

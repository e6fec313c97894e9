// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "ground_zones.hpp"
#include "land_noise.hpp"
#include "panvo/simulation/mesh.hpp"

namespace panvo::simulation {

/// What colours the ground from place to place: age, dirt, wear, damp.
class GroundPaint {
 public:
  explicit GroundPaint(const Site& site);

  /// Of the carriageway, `kerb_m` from the kerb (negative) and so far into the street, in a zone.
  Tint carriageway(const Eigen::Vector2d& point, double kerb_m, double into_street_m, const Zone& zone) const;
  /// Of a band beside it.
  Tint beside(const Eigen::Vector2d& point, double kerb_m, const Eigen::Vector3f& tint) const;
  Tint grass(const Eigen::Vector2d& point, double kerb_m) const;
  /// Fields beyond the campus; meets grass() at kFieldsBegin_m from the kerb.
  Tint field(const Eigen::Vector2d& point, double kerb_m) const;
  /// Of things laid on the road: `tint` with the dirt of the place.
  Tint laid(const Eigen::Vector2d& point, const Eigen::Vector3f& tint, double contrast = 1.0) const;

  static constexpr double kFieldsBegin_m = 45.0;

 private:
  double unevenness(const Eigen::Vector2d& point) const;
  Tint tint(const Eigen::Vector2d& point, const Eigen::Vector3f& colour, double contrast = 1.0) const;

  const Site& site_;
  LandNoise fine_, medium_, coarse_, dirt_, field_, field_share_;
  Eigen::Vector3f far_from_grass_;  ///< tint with which far land looks like grass
};

}  // namespace panvo::simulation

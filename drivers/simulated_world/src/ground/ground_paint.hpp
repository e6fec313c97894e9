// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "ground_zones.hpp"
#include "panvo/simulated_world/mesh.hpp"
#include "panvo/simulated_world/random.hpp"

namespace panvo::simulated_world {

/// Smooth noise over the plan: values in [-1, 1], feature size `size_m`, determined by seed and purpose.
class LandNoise {
 public:
  LandNoise(std::uint64_t seed, std::string_view purpose, double size_m)
      : salt_(Random(seed, purpose).bits()), per_m_(1.0 / size_m) {}

  double at(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d place = point * per_m_;
    const double column = std::floor(place.x()), row = std::floor(place.y());
    const double x = ease(place.x() - column), y = ease(place.y() - row);
    const double low = (1.0 - x) * lattice(column, row) + x * lattice(column + 1.0, row);
    const double high = (1.0 - x) * lattice(column, row + 1.0) + x * lattice(column + 1.0, row + 1.0);
    return (1.0 - y) * low + y * high;
  }

 private:
  static double ease(double t) { return t * t * (3.0 - 2.0 * t); }
  double lattice(double column, double row) const {
    const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(column));
    const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(row));
    return static_cast<double>(mix(mix(salt_ + x) + y) >> 11) * 0x1.0p-52 - 1.0;
  }

  std::uint64_t salt_;
  double per_m_;
};

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

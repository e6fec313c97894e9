// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "panvo/fleet/shared_map.hpp"

namespace panvo::fleet {

inline constexpr std::int64_t kSecond = 1'000'000'000;  ///< ns

/// Flat pose: position and yaw.
inline Eigen::Isometry3d flat(double x, double y, double yaw_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x, y, 0.0;
  pose.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

inline vision::Matrix6d covariance_of(double position_m, double rotation_rad) {
  vision::Vector6d variance;
  variance << Eigen::Vector3d::Constant(position_m * position_m),
      Eigen::Vector3d::Constant(rotation_rad * rotation_rad);
  return variance.asDiagonal();
}

inline landmarks::PanoramicLandmark place_at(std::uint32_t id, const Eigen::Isometry3d& pose) {
  landmarks::PanoramicLandmark place;
  place.id = id;
  place.stamp_ns = 1'000'000'000LL * id;
  place.map_from_base = pose;
  place.covariance = covariance_of(0.02, 0.001);
  place.description.histogram = {0.25F, 0.75F};
  place.description.large = {{3, 0.5F, 0.1F, 0.9F}};
  place.description.small = {{4, -0.5F, 0.1F, 0.8F}};
  return place;
}

/// Two maps of one road along x, with a place every ten metres: place i at x = 10 i in the world. Each map has its own
/// origin.
struct TwoMaps {
  static constexpr MapId kA = 11, kB = 22;
  static constexpr std::uint32_t kPlaces = 12;

  TwoMaps() {
    for (std::uint32_t id = 1; id <= kPlaces; ++id) {
      a.add(place_at(id, a_from_world * world_place(id)));
      b.add(place_at(id, b_from_world * world_place(id)));
    }
  }

  static Eigen::Isometry3d world_place(std::uint32_t id) { return flat(10.0 * id, 0.0, 0.0); }
  Eigen::Isometry3d a_from_b() const { return a_from_world * b_from_world.inverse(); }

  /// Robot A sees place `seen` of B from its own place `own`; `error`: what it measures wrongly.
  void a_sees(std::uint32_t own, std::uint32_t seen, const Eigen::Isometry3d& error = Eigen::Isometry3d::Identity()) {
    a.add(sighting(own, {kB, seen}, error));
  }
  void b_sees(std::uint32_t own, std::uint32_t seen, const Eigen::Isometry3d& error = Eigen::Isometry3d::Identity()) {
    b.add(sighting(own, {kA, seen}, error));
  }
  Sighting sighting(std::uint32_t own, const PlaceKey& seen, const Eigen::Isometry3d& error) {
    return {slot++,
            own,
            seen,
            error * world_place(own).inverse() * world_place(seen.place),
            covariance_of(0.05, 0.003),
            40,
            10.0 * own};
  }

  const Eigen::Isometry3d a_from_world = flat(5.0, -3.0, 0.4);
  const Eigen::Isometry3d b_from_world = flat(-40.0, 8.0, -2.0);
  SharedMap a{kA, 1, 1000}, b{kB, 1, 1000};
  std::uint32_t slot = 0;
};

}  // namespace panvo::fleet

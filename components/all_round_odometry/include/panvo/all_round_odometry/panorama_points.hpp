// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace panvo::all_round_odometry {

/// A point of a reference panorama, seen in a later one. Bearings are unit vectors from the camera, in the axes of the
/// vehicle (x forward, y left, z up) at each time.
struct Sighting {
  int id = 0;  ///< of the point in the reference panorama
  Eigen::Vector3d then, now;
  Eigen::Vector2d variance_rad2;  ///< of `now`, along azimuth (great-circle angle) and elevation
};

/// Points of one reference panorama.
struct PointTracks {
  std::int64_t from_ns = 0;  ///< stamp of the reference
  std::vector<Sighting> sightings;
};

/// What a panorama shows of the points of its reference and of the reference before.
struct PanoramaPoints {
  std::int64_t stamp_ns = 0;
  Eigen::Matrix3d now_from_then = Eigen::Matrix3d::Identity();  ///< approximate rotation since the reference
  std::vector<PointTracks> tracks;                              ///< that of the reference first
};

/// The same in other axes of the vehicle.
PanoramaPoints turned(PanoramaPoints panorama, const Eigen::Matrix3d& by);

/// Turn to the left since the reference, rad. Precondition: there is one.
double turn_in(const PanoramaPoints& panorama);
/// That turn beyond another one, rad, in (-pi, pi]: both are known up to full turns.
double turn_beyond(double turn_rad, const PanoramaPoints& panorama);

/// Shifts all stamps back.
void set_back(PanoramaPoints& panorama, std::int64_t by_ns);

}  // namespace panvo::all_round_odometry

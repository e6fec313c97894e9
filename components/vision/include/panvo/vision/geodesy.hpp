// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace panvo::vision {

/// On the ellipsoid of WGS 84, as satellite receivers state positions.
struct GeoPoint {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double altitude_m = 0.0;  ///< above the ellipsoid
};

/// Frame with axes east, north, up that touches the ellipsoid at its origin.
class TangentPlane {
 public:
  explicit TangentPlane(const GeoPoint& origin);

  const GeoPoint& origin() const noexcept { return origin_; }
  Eigen::Vector3d enu(const GeoPoint& point) const;
  /// Inverse of enu(), exact to a millimetre within 100 km of altitude.
  GeoPoint geodetic(const Eigen::Vector3d& enu_m) const;

 private:
  GeoPoint origin_;
  Eigen::Isometry3d earth_from_enu_;  // of the axes fixed in the earth (ECEF)
};

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/geodesy.hpp"

#include <cmath>

#include "panvo/vision/angle.hpp"

namespace panvo::vision {
namespace {

constexpr double kRadius_m = 6378137.0;  // WGS 84: equator
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
// Each iteration reduces the error of the latitude by the squared eccentricity, 1/150.
constexpr int kLatitudeIterations = 6;

double radius_across(double sine_latitude) {
  return kRadius_m / std::sqrt(1.0 - kEccentricity2 * sine_latitude * sine_latitude);
}

Eigen::Vector3d in_earth(const GeoPoint& point) {
  const double latitude = point.latitude_deg * kDegree, longitude = point.longitude_deg * kDegree;
  const double radius_m = radius_across(std::sin(latitude));
  return {(radius_m + point.altitude_m) * std::cos(latitude) * std::cos(longitude),
          (radius_m + point.altitude_m) * std::cos(latitude) * std::sin(longitude),
          (radius_m * (1.0 - kEccentricity2) + point.altitude_m) * std::sin(latitude)};
}

GeoPoint on_ellipsoid(const Eigen::Vector3d& earth_m) {
  const double from_axis_m = std::hypot(earth_m.x(), earth_m.y());
  double latitude = std::atan2(earth_m.z(), from_axis_m * (1.0 - kEccentricity2));
  for (int i = 0; i < kLatitudeIterations; ++i) {
    const double sine = std::sin(latitude);
    latitude = std::atan2(earth_m.z() + kEccentricity2 * radius_across(sine) * sine, from_axis_m);
  }
  const double sine = std::sin(latitude);
  // Along the vertical: also exact at the poles, where the distance from the axis vanishes.
  const double altitude_m =
      from_axis_m * std::cos(latitude) + earth_m.z() * sine - kRadius_m * std::sqrt(1.0 - kEccentricity2 * sine * sine);
  return {latitude / kDegree, std::atan2(earth_m.y(), earth_m.x()) / kDegree, altitude_m};
}

}  // namespace

TangentPlane::TangentPlane(const GeoPoint& origin) : origin_(origin), earth_from_enu_(Eigen::Isometry3d::Identity()) {
  const double latitude = origin.latitude_deg * kDegree, longitude = origin.longitude_deg * kDegree;
  const Eigen::Vector3d east(-std::sin(longitude), std::cos(longitude), 0.0);
  const Eigen::Vector3d up(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                           std::sin(latitude));
  earth_from_enu_.linear() << east, up.cross(east), up;
  earth_from_enu_.translation() = in_earth(origin);
}

Eigen::Vector3d TangentPlane::enu(const GeoPoint& point) const { return earth_from_enu_.inverse() * in_earth(point); }

GeoPoint TangentPlane::geodetic(const Eigen::Vector3d& enu_m) const { return on_ellipsoid(earth_from_enu_ * enu_m); }

}  // namespace panvo::vision

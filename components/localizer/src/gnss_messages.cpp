// SPDX-License-Identifier: Apache-2.0
#include "gnss_messages.hpp"

#include <cmath>
#include <string>

#include "panvo/conversions/time.hpp"

namespace panvo::localizer {
namespace {

namespace constants = sensor_msgs::msg::NavSatFix_Constants;
namespace status = sensor_msgs::msg::NavSatStatus_Constants;

constexpr double kUsualSigma_m = 5.0;  // of a receiver without corrections, horizontally
constexpr double kUsualHeight_m = 10.0;
constexpr double kUnknownHeight_m = 1e4;
constexpr double kLeastVariance_m2 = 1e-4;  // no receiver is better than a centimetre
constexpr double kMostAltitude_m = 1e5;

Eigen::Matrix3d usual_covariance() {
  return Eigen::Vector3d(kUsualSigma_m, kUsualSigma_m, kUsualHeight_m).cwiseAbs2().asDiagonal();
}

}  // namespace

conversions::Result<SatellitePosition> to_position(const sensor_msgs::msg::NavSatFix& message,
                                                   double usual_altitude_m) {
  if (message.status().status() < status::STATUS_FIX) return conversions::Reason{"has no position: status NO_FIX"};
  SatellitePosition position{{message.latitude(), message.longitude(), message.altitude()}, usual_covariance()};
  auto& point = position.point;
  if (point.latitude_deg == 0.0 && point.longitude_deg == 0.0)
    return conversions::Reason{"states latitude and longitude 0: the receiver has no position yet"};
  const bool has_altitude = std::isfinite(point.altitude_m) && std::abs(point.altitude_m) < kMostAltitude_m;
  if (!has_altitude) point.altitude_m = usual_altitude_m;
  const Eigen::Matrix3d stated =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(message.position_covariance().data());
  if (message.position_covariance_type() != constants::COVARIANCE_TYPE_UNKNOWN) {
    position.covariance = stated + kLeastVariance_m2 * Eigen::Matrix3d::Identity();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {  // receivers that say nothing of the height leave it 0
      if (stated(axis, axis) == 0.0) position.covariance(axis, axis) = usual_covariance()(axis, axis);
    }
  }
  if (!has_altitude) position.covariance(2, 2) = kUnknownHeight_m * kUnknownHeight_m;
  return position;
}

sensor_msgs::msg::NavSatFix to_fix(const PoseInMap& enu_from_base, const vision::TangentPlane& plane,
                                   std::int64_t stamp_ns, const std::string& base_frame) {
  const auto point = plane.geodetic(enu_from_base.map_from_base.translation());
  sensor_msgs::msg::NavSatFix fix;
  fix.header().stamp(conversions::to_stamp(stamp_ns));
  fix.header().frame_id(base_frame);
  fix.status().status(status::STATUS_FIX);
  fix.latitude(point.latitude_deg);
  fix.longitude(point.longitude_deg);
  fix.altitude(point.altitude_m);
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(fix.position_covariance().data()) =
      enu_from_base.covariance.topLeftCorner<3, 3>();
  fix.position_covariance_type(constants::COVARIANCE_TYPE_KNOWN);
  return fix;
}

}  // namespace panvo::localizer

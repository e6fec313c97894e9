// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "panvo/conversions/result.hpp"
#include "panvo/localizer/local_pose_graph.hpp"
#include "panvo/vision/geodesy.hpp"
#include "sensor_msgs/msg/NavSatFix.h"

/// Conversions of positions by satellites.
namespace panvo::localizer {

/// Position of an antenna with its covariance, east, north, up, m^2.
struct SatellitePosition {
  vision::GeoPoint point;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// Of a message that satisfies its rules. Variances that are unknown or 0: of a receiver without corrections.
/// `usual_altitude_m` replaces an altitude that the message lacks. reason() says why a message gives no position.
conversions::Result<SatellitePosition> to_position(const sensor_msgs::msg::NavSatFix& message, double usual_altitude_m);

/// The vehicle's position, if the frame of the satellites touches the earth at `plane`.
sensor_msgs::msg::NavSatFix to_fix(const PoseInMap& enu_from_base, const vision::TangentPlane& plane,
                                   std::int64_t stamp_ns, const std::string& base_frame);

}  // namespace panvo::localizer

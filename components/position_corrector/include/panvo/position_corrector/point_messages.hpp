// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "panvo/interfaces/topic.hpp"
#include "panvo/position_corrector/landmark_matcher.hpp"
#include "sensor_msgs/msg/PointCloud2.h"

namespace panvo::position_corrector {

/// Points of the recognised landmark, for viewers. Only made for readers.
inline constexpr interfaces::Topic<sensor_msgs::msg::PointCloud2> kLandmarkPoints{"landmarks/match_points",
                                                                                  interfaces::qos::kSensorData};

/// The points of a landmark that the panorama shows. x, y, z: in the panorama's frame, m; NaN without a pose. u, v:
/// where the panorama shows them, place_u, place_v: where the panorama of the landmark did, as fractions of its width
/// and height, [0, 1). landmark: its id. state: 1 agrees with the pose, 2 contradicts it. `panorama_from_level`: rotation
/// of the panorama in which the landmark was recognised, if it was levelled.
sensor_msgs::msg::PointCloud2 to_point_cloud(const LandmarkMatch& match, const std::string& panorama_frame,
                                             const Eigen::Matrix3d& panorama_from_level = Eigen::Matrix3d::Identity());

}  // namespace panvo::position_corrector

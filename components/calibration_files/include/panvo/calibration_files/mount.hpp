// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "panvo/calibration_files/yaml_map.hpp"

namespace panvo::calibration_files {

/// How a camera is mounted on a vehicle or a rig (x forward, y left, z up): a camera that looks forward, turned by yaw
/// to the left, then by pitch down, then by roll clockwise.
struct Mount {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
};

/// Rotation of the optical axes (x right, y down, z forward) of a camera that looks forward to those of the vehicle.
Eigen::Matrix3d base_from_forward();

/// The turn alone, in the axes of the vehicle.
Eigen::Matrix3d rotation_of(const Mount& mount);

/// Pose of the optical frame on the vehicle or rig.
Eigen::Isometry3d base_from_camera(const Mount& mount);

/// Reads the keys position_m, yaw_deg, pitch_deg and roll_deg; those that are missing are as in `instead`.
Mount read_mount(YamlMap& map, const Mount& instead = {});

}  // namespace panvo::calibration_files

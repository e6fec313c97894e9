// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "panvo/calibration_files/yaml_map.hpp"

namespace panvo::calibration_files {

/// Reads a required 4 x 4 matrix, row by row, and rejects it unless it is a rigid transform, up to the digits of a
/// file. Identity if it is wrong.
Eigen::Matrix4d read_rigid_matrix(YamlMap& map, const std::string& key);

/// The same as a pose with the nearest rotation.
Eigen::Isometry3d read_rigid_transform(YamlMap& map, const std::string& key);

}  // namespace panvo::calibration_files

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "panvo/vision/camera.hpp"

/// Checks of calibration parameters; each problem is appended to `problems` as a sentence.
namespace panvo::vision {

void check_camera(const std::string& name, const PinholeCamera& camera, std::vector<std::string>& problems);
void check_rotation(const std::string& name, const Eigen::Matrix3d& rotation, std::vector<std::string>& problems);
void check_baseline(double baseline_m, std::vector<std::string>& problems);

}  // namespace panvo::vision

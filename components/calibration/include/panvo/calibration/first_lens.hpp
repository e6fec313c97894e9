// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "panvo/calibration/observations.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// Initial lens: no distortion, principal point at the image centre, and the focal length with the smallest
/// reprojection error of linear board poses; LensCoefficient::start for the coefficients. `views`: the camera's
/// corners, by view. Returns nullopt if no view yields a board pose.
std::optional<vision::LensCamera> first_lens(const std::vector<std::vector<Corner>>& views,
                                             const std::vector<Eigen::Vector3d>& board_points, cv::Size image_size,
                                             vision::LensModel model);

}  // namespace panvo::calibration

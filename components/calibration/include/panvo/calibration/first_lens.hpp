// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "panvo/calibration/observations.hpp"
#include "panvo/vision/lens.hpp"

namespace panvo::calibration {

/// A lens to begin with: without distortion, seen through the middle of the image, and of the focal length with which the board's corners lie
/// nearest to where a flat board has them. `views`: the corners of each view that this camera has. nullopt: no view gives a pose.
std::optional<vision::LensCamera> first_lens(const std::vector<std::vector<Corner>>& views,
                                             const std::vector<Eigen::Vector3d>& board_points, cv::Size image_size,
                                             vision::LensModel model);

}  // namespace panvo::calibration

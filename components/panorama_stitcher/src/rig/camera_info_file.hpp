// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/vision/lens.hpp"

namespace panvo::panorama_stitcher {

/// Reads the lens of a ROS camera_info file: image_width, image_height, camera_matrix, distortion_model and
/// distortion_coefficients; other keys are ignored. Returns nullopt and appends to `problems` if it is invalid.
std::optional<vision::LensCamera> read_camera_info(const std::filesystem::path& file,
                                                   std::vector<std::string>& problems);

}  // namespace panvo::panorama_stitcher

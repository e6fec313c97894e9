// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "panvo/vision/lens.hpp"

namespace panvo::panorama_stitcher {

/// The lens of a ROS camera_info file (image_width, image_height, camera_matrix, distortion_model, distortion_coefficients; what concerns
/// stereo pairs is not looked at). What is wrong is added to `problems`.
std::optional<vision::LensCamera> read_camera_info(const std::filesystem::path& file,
                                                   std::vector<std::string>& problems);

}  // namespace panvo::panorama_stitcher

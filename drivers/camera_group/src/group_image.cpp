// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/group_image.hpp"

#include <filesystem>

#include "panvo/camera_stream/camera_info_file.hpp"

namespace panvo::camera_group {

std::vector<GroupImage> images_of(const std::vector<camera_stream::CameraRole>& roles,
                                  const std::string& calibration_folder, std::vector<std::string>& problems) {
  std::vector<GroupImage> images;
  for (const auto& role : roles) {
    images.push_back({role, std::nullopt});
    if (calibration_folder.empty()) continue;
    try {
      images.back().calibration =
          camera_stream::read_camera_info(std::filesystem::path(calibration_folder) / (role.name + ".yaml"));
    } catch (const calibration_files::FileError& error) {
      problems.emplace_back(error.what());
    }
  }
  return images;
}

}  // namespace panvo::camera_group

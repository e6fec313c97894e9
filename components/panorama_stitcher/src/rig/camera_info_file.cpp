// SPDX-License-Identifier: Apache-2.0
#include "camera_info_file.hpp"

#include <stdexcept>

#include "panvo/panorama_stitcher/rig_file.hpp"
#include "yaml_map.hpp"

namespace panvo::panorama_stitcher {
namespace {

constexpr int kMaxSize_px = 1 << 16;

}  // namespace

std::optional<vision::LensCamera> read_camera_info(const std::filesystem::path& file,
                                                   std::vector<std::string>& problems) {
  const std::size_t problems_before = problems.size();
  try {
    YamlMap map(file, load_yaml(file), problems);
    for (const char* key :
         {"image_width", "image_height", "camera_matrix", "distortion_model", "distortion_coefficients"})
      map.require(key);
    vision::PinholeCamera pinhole;
    pinhole.width = map.integer("image_width", 0, 1, kMaxSize_px);
    pinhole.height = map.integer("image_height", 0, 1, kMaxSize_px);
    const auto matrix = map.numbers("camera_matrix", 9);
    const auto model = map.text("distortion_model", "");
    const auto coefficients = map.numbers("distortion_coefficients", 0);
    if (problems.size() > problems_before) return std::nullopt;
    pinhole.fx = matrix[0];
    pinhole.cx = matrix[2];
    pinhole.fy = matrix[4];
    pinhole.cy = matrix[5];
    try {
      return vision::lens_camera(model, coefficients, pinhole);
    } catch (const std::invalid_argument& error) {
      map.reject("distortion_model", std::string(": the camera ") + error.what());
    }
  } catch (const RigFileError& error) {
    problems.emplace_back(error.what());
  }
  return std::nullopt;
}

}  // namespace panvo::panorama_stitcher

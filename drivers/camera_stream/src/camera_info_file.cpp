// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/camera_info_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "panvo/calibration_files/camera_info.hpp"

namespace panvo::camera_stream {

sensor_msgs::msg::CameraInfo read_camera_info(const std::filesystem::path& file) {
  const auto camera = calibration_files::read_camera_info(file, calibration_files::Rectification::kRequired);
  sensor_msgs::msg::CameraInfo info;
  info.width(static_cast<std::uint32_t>(camera.width));
  info.height(static_cast<std::uint32_t>(camera.height));
  info.distortion_model(camera.distortion_model);
  info.d() = camera.distortion_coefficients;
  std::copy_n(camera.camera_matrix.data(), info.k().size(), info.k().begin());
  std::copy_n(camera.rectification_matrix.data(), info.r().size(), info.r().begin());
  std::copy_n(camera.projection_matrix.data(), info.p().size(), info.p().begin());
  return info;
}

std::string size_problem(const sensor_msgs::msg::CameraInfo& info, int width, int height) {
  if (std::cmp_equal(info.width(), width) && std::cmp_equal(info.height(), height)) return {};
  return fmt::format(
      "the calibration is for {} x {} px, the camera sends {} x {} px: set the camera to the calibrated size, "
      "or calibrate again",
      info.width(), info.height(), width, height);
}

}  // namespace panvo::camera_stream

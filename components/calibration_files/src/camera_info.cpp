// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/camera_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "panvo/calibration_files/write_file.hpp"
#include "panvo/calibration_files/yaml_map.hpp"

namespace panvo::calibration_files {
namespace {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor34d = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

constexpr int kMaxSize_px = 1 << 16;

void read_camera_matrix(YamlMap& map, CameraInfo& info) {
  const std::size_t problems = map.problems();
  info.camera_matrix = Eigen::Map<const RowMajor3d>(map.numbers("camera_matrix", 9).data());
  if (map.problems() == problems && !(info.camera_matrix(0, 0) > 0.0 && info.camera_matrix(1, 1) > 0.0))
    map.reject("camera_matrix", "must have positive focal lengths; calibrate the camera");
}

std::vector<std::string_view> lens_names() {
  std::vector<std::string_view> names;
  for (const auto model : vision::kLensModels) names.push_back(vision::ros_name(model));
  return names;
}

void read_distortion(YamlMap& map, CameraInfo& info) {
  info.distortion_model = map.text("distortion_model", "");
  info.distortion_coefficients = map.numbers("distortion_coefficients");
  info.model_at = map.where("distortion_model");
  const auto& coefficients = info.distortion_coefficients;
  const bool is_distorted = std::any_of(coefficients.begin(), coefficients.end(), [](double k) { return k != 0.0; });
  if (info.distortion_model.empty() && is_distorted)
    map.reject("distortion_model", fmt::format("is missing; add it: {}", fmt::join(lens_names(), ", ")));
}

/// P of a single camera: without rectification.
RowMajor34d unrectified(const RowMajor3d& k) {
  RowMajor34d projection;
  projection << k(0, 0), 0, k(0, 2), 0, 0, k(1, 1), k(1, 2), 0, 0, 0, 1, 0;
  return projection;
}

std::string list_of(const double* values, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += fmt::format("{}{:.12g}", i == 0 ? "" : ", ", values[i] == 0.0 ? 0.0 : values[i]);  // without -0
  return "[" + text + "]";
}

std::string matrix_of(const char* key, int rows, int columns, const double* values) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: {}\n", key, rows, columns,
                     list_of(values, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns)));
}

}  // namespace

vision::LensCamera CameraInfo::lens() const {
  const auto& k = camera_matrix;
  try {
    return vision::lens_camera(distortion_model, distortion_coefficients,
                               {k(0, 0), k(1, 1), k(0, 2), k(1, 2), width, height});
  } catch (const std::invalid_argument& error) {
    throw FileError(fmt::format("{} cannot be used: the camera {}", model_at.empty() ? name : model_at, error.what()));
  }
}

CameraInfo single_camera_info(const std::string& name, const vision::LensCamera& lens) {
  const auto& p = lens.pinhole;
  CameraInfo info;
  info.name = name;
  info.width = p.width;
  info.height = p.height;
  info.camera_matrix << p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1;
  info.distortion_model = vision::ros_name(lens.model);
  info.distortion_coefficients = vision::ros_coefficients(lens);
  info.projection_matrix = unrectified(info.camera_matrix);
  return info;
}

CameraInfo read_camera_info(const std::filesystem::path& file, Rectification rectification) {
  YamlMap map(file, "a ROS camera_info file");
  CameraInfo info;
  info.file = file;
  info.name = map.text("camera_name", file.stem().string());
  info.width = map.integer("image_width", 1, kMaxSize_px);
  info.height = map.integer("image_height", 1, kMaxSize_px);
  read_camera_matrix(map, info);
  read_distortion(map, info);
  const bool is_required = rectification == Rectification::kRequired;
  if (is_required || map.has("rectification_matrix"))
    info.rectification_matrix = Eigen::Map<const RowMajor3d>(map.numbers("rectification_matrix", 9).data());
  if (is_required || map.has("projection_matrix")) {
    info.projection_matrix = Eigen::Map<const RowMajor34d>(map.numbers("projection_matrix", 12).data());
  } else {
    info.projection_matrix = unrectified(info.camera_matrix);
  }
  map.check();
  return info;
}

void write_camera_info(const std::filesystem::path& file, const CameraInfo& info) {
  const auto& d = info.distortion_coefficients;
  std::string text =
      fmt::format("image_width: {}\nimage_height: {}\ncamera_name: {}\n", info.width, info.height, info.name);
  text += matrix_of("camera_matrix", 3, 3, info.camera_matrix.data());
  text += fmt::format("distortion_model: {}\n", info.distortion_model);
  text += matrix_of("distortion_coefficients", 1, static_cast<int>(d.size()), d.data());
  text += matrix_of("rectification_matrix", 3, 3, info.rectification_matrix.data());
  text += matrix_of("projection_matrix", 3, 4, info.projection_matrix.data());
  write_file(file, text);
}

}  // namespace panvo::calibration_files

// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/camera_info_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "panvo/calibration/calibration_error.hpp"
#include "yaml_document.hpp"

namespace panvo::calibration {
namespace {

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor34d = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

constexpr int kMaxSize_px = 1 << 16;
constexpr double kSame_px = 1e-3;

std::string list_of(const double* values, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i)
    text += fmt::format("{}{:.12g}", i == 0 ? "" : ", ", values[i] == 0.0 ? 0.0 : values[i]);
  return "[" + text + "]";
}

std::string matrix_of(const char* key, int rows, int columns, const double* values) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: {}\n", key, rows, columns,
                     list_of(values, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns)));
}

}  // namespace

CameraInfo single_camera_info(const std::string& name, const vision::LensCamera& lens) {
  CameraInfo info{name, lens};
  const auto& p = lens.pinhole;
  info.projection << p.fx, 0, p.cx, 0, 0, p.fy, p.cy, 0, 0, 0, 1, 0;
  return info;
}

std::pair<CameraInfo, CameraInfo> stereo_camera_infos(const vision::LensCamera& left, const vision::LensCamera& right,
                                                      const vision::RectifiedStereo& pair) {
  CameraInfo of_left{"left", left, pair.rectified_left_from_left};
  CameraInfo of_right{"right", right, pair.rectified_right_from_right};
  const auto& p = pair.camera;
  of_left.projection << p.fx, 0, p.cx, 0, 0, p.fy, p.cy, 0, 0, 0, 1, 0;
  of_right.projection = of_left.projection;
  of_right.projection(0, 3) = -p.fx * pair.baseline_m;
  return {of_left, of_right};
}

vision::RectifiedStereo rectified_pair(const CameraInfo& left, const CameraInfo& right,
                                       const std::filesystem::path& folder) {
  const auto fail = [&](const std::string& what) {
    throw CalibrationError(folder.string() + ": " + what + "; calibrate both together: panvo calibrate stereo");
  };
  if ((left.projection.leftCols<3>() - right.projection.leftCols<3>()).cwiseAbs().maxCoeff() > kSame_px)
    fail("projection_matrix of left.yaml and right.yaml differ in more than the last column");
  const auto& p = right.projection;
  vision::RectifiedStereo pair;
  pair.camera = {p(0, 0), p(1, 1), p(0, 2), p(1, 2), right.lens.pinhole.width, right.lens.pinhole.height};
  pair.baseline_m = -p(0, 3) / p(0, 0);
  pair.rectified_left_from_left = left.rectified_from_raw;
  pair.rectified_right_from_right = right.rectified_from_raw;
  if (const auto problems = vision::validate(pair); !problems.empty()) fail(problems.front());
  return pair;
}

CameraInfo read_camera_info(const std::filesystem::path& file) {
  const YamlDocument yaml(file, "a ROS camera_info file");
  vision::PinholeCamera pinhole;
  pinhole.width = yaml.integer("image_width", 1, kMaxSize_px);
  pinhole.height = yaml.integer("image_height", 1, kMaxSize_px);
  const auto matrix = yaml.numbers("camera_matrix", 9);
  pinhole.fx = matrix[0];
  pinhole.fy = matrix[4];
  pinhole.cx = matrix[2];
  pinhole.cy = matrix[5];
  if (!(pinhole.fx > 0.0 && pinhole.fy > 0.0))
    yaml.fail("camera_matrix", "must have positive focal lengths; calibrate the camera");
  CameraInfo info;
  try {
    info = single_camera_info(
        file.stem().string(),
        vision::lens_camera(yaml.text("distortion_model"), yaml.numbers("distortion_coefficients", 0), pinhole));
  } catch (const std::invalid_argument& error) {
    yaml.fail("distortion_model", std::string(": the camera ") + error.what());
  }
  if (yaml.has("camera_name")) info.name = yaml.text("camera_name");
  if (yaml.has("rectification_matrix"))
    info.rectified_from_raw = Eigen::Map<const RowMajor3d>(yaml.numbers("rectification_matrix", 9).data());
  if (yaml.has("projection_matrix"))
    info.projection = Eigen::Map<const RowMajor34d>(yaml.numbers("projection_matrix", 12).data());
  return info;
}

void write_camera_info(const std::filesystem::path& file, const CameraInfo& info) {
  const auto& p = info.lens.pinhole;
  const std::array<double, 9> matrix{p.fx, 0.0, p.cx, 0.0, p.fy, p.cy, 0.0, 0.0, 1.0};
  const auto coefficients = vision::ros_coefficients(info.lens);
  const RowMajor3d rectification = info.rectified_from_raw;
  const RowMajor34d projection = info.projection;
  std::string text = fmt::format("image_width: {}\nimage_height: {}\ncamera_name: {}\n", p.width, p.height, info.name);
  text += matrix_of("camera_matrix", 3, 3, matrix.data());
  text += fmt::format("distortion_model: {}\n", vision::ros_name(info.lens.model));
  text += matrix_of("distortion_coefficients", 1, static_cast<int>(coefficients.size()), coefficients.data());
  text += matrix_of("rectification_matrix", 3, 3, rectification.data());
  text += matrix_of("projection_matrix", 3, 4, projection.data());
  write_text(file, text);
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  auto partial = file;
  partial += ".partial";
  std::error_code error;
  std::ofstream stream(partial, std::ios::binary);
  const bool is_written = static_cast<bool>((stream << text).flush());
  stream.close();
  if (is_written) std::filesystem::rename(partial, file, error);
  if (!is_written || error)
    throw CalibrationError(file.string() + ": cannot be written; choose a writable folder with --out");
}

}  // namespace panvo::calibration

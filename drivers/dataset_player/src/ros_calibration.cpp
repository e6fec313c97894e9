// SPDX-License-Identifier: Apache-2.0
#include "calibration_values.hpp"
#include "panvo/dataset_player/calibration_file.hpp"
#include "yaml_file.hpp"

namespace panvo::dataset_player {
namespace {

struct CameraInfoFile {
  vision::LensCamera raw;
  Eigen::Matrix3d rectified_from_raw;
  RowMajor34d projection;
};

CameraInfoFile read_camera_info(const std::filesystem::path& path) {
  const YamlFile file(path);
  const ImageSize size{file.integer("image_width"), file.integer("image_height")};
  CameraInfoFile camera;
  camera.raw = lens(file, "distortion_coefficients", file.text("distortion_model", "plumb_bob"),
                    pinhole(file.numbers("camera_matrix", 9), size));
  camera.rectified_from_raw = Eigen::Map<const RowMajor3d>(file.numbers("rectification_matrix", 9).data());
  camera.projection = Eigen::Map<const RowMajor34d>(file.numbers("projection_matrix", 12).data());
  return camera;
}

}  // namespace

CalibratedStereo read_ros_calibration(const std::filesystem::path& left_file, const std::filesystem::path& right_file) {
  const auto left = read_camera_info(left_file);
  const auto right = read_camera_info(right_file);
  const auto& p = right.projection;

  CalibratedStereo stereo;
  auto& rectified = stereo.rectified;
  rectified.camera = {p(0, 0), p(1, 1), p(0, 2), p(1, 2), right.raw.pinhole.width, right.raw.pinhole.height};
  rectified.baseline_m = -p(0, 3) / p(0, 0);
  rectified.rectified_left_from_left = left.rectified_from_raw;
  rectified.rectified_right_from_right = right.rectified_from_raw;
  auto problems = vision::validate(rectified);
  if ((left.projection.leftCols<3>() - p.leftCols<3>()).cwiseAbs().maxCoeff() > 1e-3) {
    problems.push_back("projection_matrix differs from that of " + left_file.string() +
                       " in more than its last column: the cameras were not calibrated as a stereo pair");
  }
  expect_no_problems(problems, right_file);

  // In the rectified frames the right camera is at baseline_m along +X of the left one, with the same axes.
  const Eigen::Vector3d rectified_right_from_rectified_left(-rectified.baseline_m, 0.0, 0.0);
  auto& [left_camera, right_camera, right_from_left] = stereo.calibration;
  left_camera = left.raw;
  right_camera = right.raw;
  right_from_left.linear() = right.rectified_from_raw.transpose() * left.rectified_from_raw;
  right_from_left.translation() = right.rectified_from_raw.transpose() * rectified_right_from_rectified_left;
  expect_no_problems(vision::validate(stereo.calibration), right_file);
  return stereo;
}

}  // namespace panvo::dataset_player

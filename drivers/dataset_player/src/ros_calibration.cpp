// SPDX-License-Identifier: Apache-2.0
#include "calibration_values.hpp"
#include "panvo/dataset_player/calibration_file.hpp"

namespace panvo::dataset_player {

CalibratedStereo read_ros_calibration(const std::filesystem::path& left_file, const std::filesystem::path& right_file) {
  using calibration_files::read_camera_info;
  using calibration_files::Rectification;
  const auto left = read_camera_info(left_file, Rectification::kRequired);
  const auto right = read_camera_info(right_file, Rectification::kRequired);
  auto stereo = calibration_files::stereo_pair(left, right);
  expect_no_problems(vision::validate(stereo.calibration), right_file);
  return stereo;
}

}  // namespace panvo::dataset_player

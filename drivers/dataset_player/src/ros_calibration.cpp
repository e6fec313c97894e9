// SPDX-License-Identifier: Apache-2.0
#include "calibration_values.hpp"
#include "panvo/dataset_player/calibration_file.hpp"

namespace panvo::dataset_player {

CalibratedStereo read_ros_calibration(const std::filesystem::path& left_file, const std::filesystem::path& right_file) {
  using calibration_files::read_camera_info;
  using calibration_files::Rectification;
  auto stereo = calibration_files::stereo_pair(read_camera_info(left_file, Rectification::kRequired),
                                               read_camera_info(right_file, Rectification::kRequired));
  expect_no_problems(vision::validate(stereo.calibration), right_file);
  return stereo;
}

}  // namespace panvo::dataset_player

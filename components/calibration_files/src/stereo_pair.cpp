// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/stereo_pair.hpp"

#include <fmt/format.h>

namespace panvo::calibration_files {
namespace {

constexpr double kSame_px = 1e-3;

/// The file, or the name of a camera that was not read from one.
std::string name_of(const CameraInfo& info) { return info.file.empty() ? info.name : info.file.string(); }

void check_pair(const CameraInfo& left, const CameraInfo& right, const vision::RectifiedStereo& pair) {
  auto problems = vision::validate(pair);
  const auto& p = right.projection_matrix;
  if (!((left.projection_matrix.leftCols<3>() - p.leftCols<3>()).cwiseAbs().maxCoeff() <= kSame_px))
    problems.emplace_back("projection_matrix differs from that of the left camera in more than the last column");
  std::string text;
  for (const auto& problem : problems)
    text += fmt::format("{}{}: {}; calibrate it together with {}: panvo calibrate stereo", text.empty() ? "" : "\n",
                        name_of(right), problem, name_of(left));
  if (!text.empty()) throw FileError(text);
}

}  // namespace

CalibratedStereo stereo_pair(const CameraInfo& left, const CameraInfo& right) {
  const auto& p = right.projection_matrix;
  CalibratedStereo stereo;
  auto& rectified = stereo.rectified;
  rectified.camera = {p(0, 0), p(1, 1), p(0, 2), p(1, 2), right.width, right.height};
  rectified.baseline_m = (0.0 - p(0, 3)) / p(0, 0);
  rectified.rectified_left_from_left = left.rectification_matrix;
  rectified.rectified_right_from_right = right.rectification_matrix;
  check_pair(left, right, rectified);

  // In the rectified frames the right camera is at baseline_m along +X of the left one, with the same axes.
  const Eigen::Vector3d rectified_right_from_rectified_left(-rectified.baseline_m, 0.0, 0.0);
  const Eigen::Matrix3d right_from_rectified = rectified.rectified_right_from_right.transpose();
  auto& [left_lens, right_lens, right_from_left] = stereo.calibration;
  left_lens = left.lens();
  right_lens = right.lens();
  right_from_left.linear() = right_from_rectified * rectified.rectified_left_from_left;
  right_from_left.translation() = right_from_rectified * rectified_right_from_rectified_left;
  return stereo;
}

std::pair<CameraInfo, CameraInfo> stereo_camera_infos(const vision::LensCamera& left, const vision::LensCamera& right,
                                                      const vision::RectifiedStereo& pair) {
  CameraInfo of_left = single_camera_info("left", left);
  CameraInfo of_right = single_camera_info("right", right);
  of_left.rectification_matrix = pair.rectified_left_from_left;
  of_right.rectification_matrix = pair.rectified_right_from_right;
  const auto& p = pair.camera;
  of_left.projection_matrix << p.fx, 0, p.cx, 0, 0, p.fy, p.cy, 0, 0, 0, 1, 0;
  of_right.projection_matrix = of_left.projection_matrix;
  of_right.projection_matrix(0, 3) = -p.fx * pair.baseline_m;
  return {of_left, of_right};
}

}  // namespace panvo::calibration_files

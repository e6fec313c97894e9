// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/camera.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "camera_checks.hpp"
#include "positive.hpp"

namespace panvo::vision {
namespace {

constexpr double kMax_px = 1e6;  // largest focal length, of a telescope
constexpr double kMaxBaseline_m = 1e3;

}  // namespace

void check_camera(const std::string& name, const PinholeCamera& camera, std::vector<std::string>& problems) {
  std::ostringstream text;
  const auto is_focal_length = [](double value) { return is_positive(value) && value <= kMax_px; };
  const auto is_place = [](double value) { return std::abs(value) <= kMax_px; };  // false for NaN
  if (!is_focal_length(camera.fx) || !is_focal_length(camera.fy)) {
    text << name << ": focal lengths fx = " << camera.fx << ", fy = " << camera.fy
         << " px must be positive numbers, at most " << kMax_px;
    problems.push_back(text.str());
  } else if (!is_place(camera.cx) || !is_place(camera.cy)) {
    text << name << ": principal point (" << camera.cx << ", " << camera.cy << ") px must be numbers, at most "
         << kMax_px;
    problems.push_back(text.str());
  }
  if (camera.width <= 0 || camera.height <= 0) {
    text.str("");
    text << name << ": image size " << camera.width << " x " << camera.height << " px must be positive";
    problems.push_back(text.str());
  }
}

void check_rotation(const std::string& name, const Eigen::Matrix3d& rotation, std::vector<std::string>& problems) {
  constexpr double kRotationTolerance = 1e-3;  // calibration files hold six digits or more
  const double deviation = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation < kRotationTolerance) || rotation.determinant() < 0.0) {
    problems.push_back(name + ": not a rotation matrix (R * R^T differs from the identity, or the determinant is -1)");
  }
}

void check_baseline(double baseline_m, std::vector<std::string>& problems) {
  if (is_positive(baseline_m) && baseline_m <= kMaxBaseline_m) return;
  std::ostringstream text;
  text << "baseline is " << baseline_m << " m; it must be a positive number, at most " << kMaxBaseline_m;
  if (baseline_m < 0.0) text << " (are the left and right cameras swapped?)";
  problems.push_back(text.str());
}

std::vector<std::string> validate(const RectifiedStereo& stereo) {
  std::vector<std::string> problems;
  check_camera("rectified camera", stereo.camera, problems);
  check_baseline(stereo.baseline_m, problems);
  check_rotation("rotation rectified_left_from_left", stereo.rectified_left_from_left, problems);
  check_rotation("rotation rectified_right_from_right", stereo.rectified_right_from_right, problems);
  return problems;
}

void expect_valid(const RectifiedStereo& stereo) {
  const auto problems = validate(stereo);
  if (problems.empty()) return;
  std::string message = "invalid rectified calibration:";
  for (const auto& problem : problems) message += "\n  - " + problem;
  throw std::invalid_argument(message);
}

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/stereo_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <stdexcept>

#include "camera_checks.hpp"

namespace panvo::vision {
namespace {

void check_distortion(const std::string& name, const LensCamera& camera, std::vector<std::string>& problems) {
  const auto is_number = [](double value) { return std::isfinite(value); };
  if (!std::all_of(camera.distortion.begin(), camera.distortion.end(), is_number))
    problems.push_back(name + ": a distortion coefficient is not a number");
}

cv::Mat camera_matrix(const PinholeCamera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

/// Distortion of a plumb_bob lens.
cv::Mat distortion_vector(const LensCamera& camera) {
  return cv::Mat(1, 5, CV_64F, const_cast<double*>(camera.distortion.data())).clone();
}

Eigen::Matrix3d to_eigen(const cv::Mat& matrix) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix.ptr<double>());
}

}  // namespace

std::vector<std::string> validate(const StereoCalibration& calibration) {
  std::vector<std::string> problems;
  const auto& [left, right, right_from_left] = calibration;
  check_camera("left camera", left.pinhole, problems);
  check_camera("right camera", right.pinhole, problems);
  if (left.pinhole.width != right.pinhole.width || left.pinhole.height != right.pinhole.height) {
    std::ostringstream text;
    text << "image sizes differ: left " << left.pinhole.width << " x " << left.pinhole.height << ", right "
         << right.pinhole.width << " x " << right.pinhole.height << " px";
    problems.push_back(text.str());
  }
  check_distortion("left camera", left, problems);
  check_distortion("right camera", right, problems);
  check_rotation("rotation right_from_left", right_from_left.linear(), problems);
  const Eigen::Vector3d right_in_left = -right_from_left.linear().transpose() * right_from_left.translation();
  check_baseline(right_in_left.x(), problems);
  if (std::abs(right_in_left.x()) < right_in_left.tail<2>().norm()) {
    problems.emplace_back("baseline does not lie along the image rows: the cameras must stand side by side");
  }
  return problems;
}

bool is_rectified(const StereoCalibration& calibration) {
  constexpr double kTolerance = 1e-6;  // files hold six digits or more
  const auto& [left, right, right_from_left] = calibration;
  if (!is_straight(left) || !is_straight(right)) return false;
  const auto& a = left.pinhole;
  const auto& b = right.pinhole;
  const double difference_px =
      std::max({std::abs(a.fx - b.fx), std::abs(a.fy - b.fy), std::abs(a.cx - b.cx), std::abs(a.cy - b.cy)});
  const Eigen::Vector3d t = right_from_left.translation();
  return difference_px <= kTolerance * a.fx &&
         (right_from_left.linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kTolerance &&
         t.tail<2>().cwiseAbs().maxCoeff() <= 10.0 * kTolerance * std::abs(t.x());
}

RectifiedStereo rectify(const StereoCalibration& calibration) {
  if (const auto problems = validate(calibration); !problems.empty()) {
    std::string message = "stereo calibration cannot be used:";
    for (const auto& problem : problems) message += "\n  - " + problem;
    throw std::invalid_argument(message);
  }
  const auto& [left, right, right_from_left] = calibration;
  if (is_rectified(calibration)) return {left.pinhole, -right_from_left.translation().x()};
  // OpenCV's method knows plumb_bob only; every other lens takes the general one
  if (left.model != LensModel::kPlumbBob || right.model != LensModel::kPlumbBob) return rectify_view(calibration);
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = right_from_left.linear();
  const Eigen::Vector3d translation = right_from_left.translation();
  cv::Mat rectified_left, rectified_right, projection_left, projection_right, disparity_to_depth;
  cv::stereoRectify(camera_matrix(left.pinhole), distortion_vector(left), camera_matrix(right.pinhole),
                    distortion_vector(right), {left.pinhole.width, left.pinhole.height},
                    cv::Mat(3, 3, CV_64F, const_cast<double*>(rotation.data())),
                    cv::Mat(3, 1, CV_64F, const_cast<double*>(translation.data())), rectified_left, rectified_right,
                    projection_left, projection_right, disparity_to_depth, cv::CALIB_ZERO_DISPARITY, 0.0);
  RectifiedStereo stereo;
  stereo.camera = {projection_left.at<double>(0, 0),
                   projection_left.at<double>(1, 1),
                   projection_left.at<double>(0, 2),
                   projection_left.at<double>(1, 2),
                   left.pinhole.width,
                   left.pinhole.height};
  stereo.baseline_m = -projection_right.at<double>(0, 3) / projection_right.at<double>(0, 0);
  stereo.rectified_left_from_left = to_eigen(rectified_left);
  stereo.rectified_right_from_right = to_eigen(rectified_right);
  return stereo;
}

}  // namespace panvo::vision

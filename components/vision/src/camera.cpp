// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/camera.hpp"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <sstream>
#include <stdexcept>

#include "positive.hpp"

namespace panvo::vision {
namespace {

constexpr double kRotationTolerance = 1e-3;  // calibration files hold six digits or more

void check_camera(const std::string& name, const PinholeCamera& camera, std::vector<std::string>& problems) {
  std::ostringstream text;
  if (!is_positive(camera.fx) || !is_positive(camera.fy)) {
    text << name << ": focal lengths fx = " << camera.fx << ", fy = " << camera.fy << " px must be positive numbers";
    problems.push_back(text.str());
  } else if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy)) {
    text << name << ": principal point (" << camera.cx << ", " << camera.cy << ") px must be numbers";
    problems.push_back(text.str());
  }
  if (camera.width <= 0 || camera.height <= 0) {
    text.str("");
    text << name << ": image size " << camera.width << " x " << camera.height << " px must be positive";
    problems.push_back(text.str());
  }
}

void check_rotation(const std::string& name, const Eigen::Matrix3d& rotation, std::vector<std::string>& problems) {
  const double deviation = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation < kRotationTolerance) || rotation.determinant() < 0.0) {
    problems.push_back(name +
                       ": the matrix is no rotation (R * R^T differs from the identity, or its determinant is -1)");
  }
}

void check_baseline(double baseline_m, std::vector<std::string>& problems) {
  if (is_positive(baseline_m)) return;
  std::ostringstream text;
  text << "baseline is " << baseline_m << " m; it must be a positive number";
  if (baseline_m < 0.0) text << " (are the left and right camera exchanged?)";
  problems.push_back(text.str());
}

cv::Mat camera_matrix(const PinholeCamera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

cv::Mat distortion_vector(const DistortedCamera& camera) {
  return cv::Mat(1, 5, CV_64F, const_cast<double*>(camera.distortion.data())).clone();
}

Eigen::Matrix3d to_eigen(const cv::Mat& matrix) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix.ptr<double>());
}

}  // namespace

Eigen::Vector2d DistortedCamera::project(const Eigen::Vector3d& point_in_camera) const {
  const auto [k1, k2, p1, p2, k3] = distortion;
  const double x = point_in_camera.x() / point_in_camera.z();
  const double y = point_in_camera.y() / point_in_camera.z();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {pinhole.fx * (x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)) + pinhole.cx,
          pinhole.fy * (y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y) + pinhole.cy};
}

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
  for (const double coefficient : left.distortion) {
    if (!std::isfinite(coefficient)) problems.emplace_back("left camera: a distortion coefficient is not a number");
  }
  for (const double coefficient : right.distortion) {
    if (!std::isfinite(coefficient)) problems.emplace_back("right camera: a distortion coefficient is not a number");
  }
  check_rotation("rotation right_from_left", right_from_left.linear(), problems);
  const Eigen::Vector3d right_in_left = -right_from_left.linear().transpose() * right_from_left.translation();
  check_baseline(right_in_left.x(), problems);
  if (std::abs(right_in_left.x()) < right_in_left.tail<2>().norm()) {
    problems.emplace_back("baseline does not lie along the image rows: the cameras must stand side by side");
  }
  return problems;
}

std::vector<std::string> validate(const RectifiedStereo& stereo) {
  std::vector<std::string> problems;
  check_camera("rectified camera", stereo.camera, problems);
  check_baseline(stereo.baseline_m, problems);
  check_rotation("rotation rectified_left_from_left", stereo.rectified_left_from_left, problems);
  check_rotation("rotation rectified_right_from_right", stereo.rectified_right_from_right, problems);
  return problems;
}

RectifiedStereo rectify(const StereoCalibration& calibration) {
  if (const auto problems = validate(calibration); !problems.empty()) {
    std::string message = "stereo calibration cannot be used:";
    for (const auto& problem : problems) message += "\n  - " + problem;
    throw std::invalid_argument(message);
  }
  const auto& [left, right, right_from_left] = calibration;
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

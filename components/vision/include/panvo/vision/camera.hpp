// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

/// Camera models. Camera frames are optical: X right, Y down, Z forward. Pixel centres lie at integer coordinates.
namespace panvo::vision {

/// Ideal perspective camera; focal lengths and principal point in pixels.
struct PinholeCamera {
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  int width = 0;   ///< px
  int height = 0;  ///< px

  /// Pixel of a point in this camera's frame. Precondition: z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& point_in_camera) const {
    return {fx * point_in_camera.x() / point_in_camera.z() + cx, fy * point_in_camera.y() / point_in_camera.z() + cy};
  }

  /// Ray through a pixel, scaled to z = 1.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0};
  }

  /// Whether a pixel lies in the image and at least margin_px away from its border.
  bool contains(const Eigen::Vector2d& pixel, double margin_px = 0.0) const {
    return pixel.x() >= margin_px && pixel.y() >= margin_px && pixel.x() <= width - 1 - margin_px &&
           pixel.y() <= height - 1 - margin_px;
  }
};

/// Rectified stereo pair: one pinhole model for both images, rows aligned, right camera at +baseline_m along X of the
/// left. Disparity d = u_left - u_right = fx * baseline_m / z, positive for every point in front.
struct RectifiedStereo {
  PinholeCamera camera;
  double baseline_m = 0.0;
  Eigen::Matrix3d rectified_left_from_left = Eigen::Matrix3d::Identity();    ///< rotation from the raw left frame
  Eigen::Matrix3d rectified_right_from_right = Eigen::Matrix3d::Identity();  ///< rotation from the raw right frame
};

/// Lists the problems of a pair, one sentence each; empty if it is valid. Checks focal lengths, principal point, image
/// size, the baseline (negative if left and right are swapped) and the rotation matrices.
std::vector<std::string> validate(const RectifiedStereo& stereo);

/// Throws std::invalid_argument with each problem that validate() finds.
void expect_valid(const RectifiedStereo& stereo);

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/vision/lens.hpp"

namespace panvo::vision {

/// Where a raw camera sees what, and how far its model may be believed. Directions are of the optical frame: X right, Y down, Z
/// forward; a wide lens sees directions with Z < 0, too. Pixel centres lie at integer coordinates.
///
/// A direction at the angle theta from the axis lies in the normalised image at the radius tan(theta) [perspective], theta
/// [Kannala2006, as OpenCV's fisheye] or sin(theta) / (cos(theta) + xi) [Mei2007]; the distortion moves it from there.
class CameraModel {
 public:
  /// `field_of_view_rad`: how much the lens sees, across; 0: as far as the model can be inverted. Throws std::invalid_argument,
  /// in words that follow the camera's name: focal lengths and sizes that are not positive, a field of view that no such lens has,
  /// a distortion that folds the image over within the field of view or, where that is not stated, before the nearest border.
  explicit CameraModel(const LensCamera& camera, double field_of_view_rad = 0.0);

  /// Pixel of a point; nullopt outside of the field of view. The pixel may lie outside of the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_camera) const;

  /// Unit vector through a pixel; nullopt where the lens shows nothing. project() takes it back to the pixel within 1e-6 px.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  /// The largest angle from the axis that is seen, rad.
  double widest_rad() const { return widest_rad_; }

  const LensCamera& camera() const { return camera_; }

 private:
  bool is_perspective() const;
  double radius(double theta_rad) const;
  double model_limit_rad() const;
  double fold_rad() const;
  Eigen::Vector2d distort(const Eigen::Vector2d& ideal, Eigen::Matrix2d* jacobian) const;
  Eigen::Vector2d first_guess(const Eigen::Vector2d& distorted) const;
  std::optional<Eigen::Vector2d> undistort(const Eigen::Vector2d& distorted) const;
  void check_numbers() const;
  void check_borders() const;

  LensCamera camera_;
  double widest_rad_ = 0.0;
  double widest_radius_ = 0.0;  ///< of the normalised image before its distortion
};

}  // namespace panvo::vision

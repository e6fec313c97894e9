// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "panvo/vision/lens.hpp"

namespace panvo::vision {

/// Projection of a raw camera and its inverse, limited to the field of view in which the model is valid. Directions are
/// in the optical frame (X right, Y down, Z forward); wide lenses also see directions with Z < 0. Pixel centres lie at
/// integer coordinates. The lens models are in lens_models/, their list is lens_models.hpp.
class CameraModel {
 public:
  /// `field_of_view_rad`: full angle; 0: as far as the model is invertible. Throws std::invalid_argument, with a text
  /// to follow the camera's name, for invalid intrinsics, a field of view beyond the limit of the lens model, or a
  /// distortion that is not invertible within the field of view (if 0: up to the nearest image border; perspective
  /// lenses: up to all borders).
  explicit CameraModel(const LensCamera& camera, double field_of_view_rad = 0.0);

  /// Pixel of a point; nullopt outside the field of view. The pixel may lie outside the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_camera) const;

  /// Unit vector through a pixel; nullopt outside the field of view. project() returns the same pixel within 1e-6 px.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  /// Largest visible angle from the axis, rad.
  double widest_rad() const { return widest_rad_; }

  const LensCamera& camera() const { return camera_; }

 private:
  void check_numbers() const;
  void check_borders() const;

  LensCamera camera_;
  double widest_rad_ = 0.0;
  double widest_radius_ = 0.0;  ///< in the normalised image, before distortion
};

}  // namespace panvo::vision

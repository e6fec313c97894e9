// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace panvo::landmark_builder {

struct GroundProjectionParameters {
  double radius_m = 22.0;
  double resolution_m = 0.25;
  double ground_height_m = 0.0;

  template <class Field>
  static void describe(Field&& field) {
    using P = GroundProjectionParameters;
    field(&P::radius_m, "radius_m", "m", "half the side of the bird's-eye view", 5.0, 100.0);
    field(&P::resolution_m, "resolution_m", "m", "side of a pixel of the bird's-eye view", 0.05, 1.0);
    field(&P::ground_height_m, "ground_height_m", "m", "height of the ground in the vehicle's base frame", -5.0, 5.0);
  }
};

/// Geometry of the square bird's-eye view: the middle pixel is the vehicle's base, rows point backwards and columns to
/// the right, so that ahead is up.
struct GroundGrid {
  int side = 0;  ///< px, odd
  double resolution_m = 0.0;

  int middle() const { return side / 2; }
  /// (column, row) of a point on the ground (base frame, m); pixel centres at integers.
  Eigen::Vector2d pixel(const Eigen::Vector2d& point_in_base) const {
    return {middle() - point_in_base.y() / resolution_m, middle() - point_in_base.x() / resolution_m};
  }
  Eigen::Vector2d point(const Eigen::Vector2d& pixel) const {
    return {(middle() - pixel.y()) * resolution_m, (middle() - pixel.x()) * resolution_m};
  }
};

/// Projects an equirectangular panorama to the ground plane under the vehicle [Lu2015 4.1]. base_from_panorama gives
/// height and tilt of the camera.
class GroundProjection {
 public:
  /// Computes the look-up table for panoramas of this size. Throws std::invalid_argument: the camera is not above the
  /// ground, or the size is not 2:1.
  GroundProjection(const GroundProjectionParameters& parameters, const Eigen::Isometry3d& base_from_panorama,
                   cv::Size panorama_size);

  /// The view of a panorama, 8UC1 or 8UC3, of the same type. Throws std::invalid_argument for another size.
  cv::Mat project(const cv::Mat& panorama) const;

  const GroundGrid& grid() const noexcept { return grid_; }
  cv::Size panorama_size() const noexcept { return size_; }
  /// Horizontal position of the camera in the base frame, m; height above the ground.
  Eigen::Vector2d camera() const noexcept { return camera_; }
  double camera_height_m() const noexcept { return camera_height_m_; }

 private:
  GroundGrid grid_;
  cv::Size size_;
  Eigen::Vector2d camera_;
  double camera_height_m_ = 0.0;
  cv::Mat places_, fractions_;  // maps of cv::remap
};

}  // namespace panvo::landmark_builder

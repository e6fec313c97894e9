// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::stereo_places {

/// Estimates by how much all disparities are too large: a small rotation between the cameras since their calibration
/// shifts them, and so scales all distances of a place. The odometry compensates for it, so its path tells: points of the
/// last place, carried along the path, must be seen where they are seen. One-state Kalman filter.
class DisparityOffset {
 public:
  /// `bearing_sigma_rad`: of a keypoint.
  DisparityOffset(const vision::RectifiedStereo& stereo, double bearing_sigma_rad);

  double px() const noexcept { return offset_px_; }
  double sigma_px() const noexcept;

  /// A place was built: keypoints with points, from disparities less px(), and the camera's pose in the odometry.
  void begin(std::vector<landmarks::Keypoint> place, const Eigen::Isometry3d& odom_from_place);

  /// A later view, without points.
  void add(std::span<const landmarks::Keypoint> view, const Eigen::Isometry3d& odom_from_view);

 private:
  struct Place {
    std::vector<landmarks::Keypoint> keypoints;
    Eigen::Isometry3d odom_from_place;
    double offset_px;  // when it was built
  };
  struct Measured {
    double offset_px, variance_px2;
  };

  std::optional<Measured> measure(const landmarks::Keypoint& known, const landmarks::Keypoint& seen,
                                  const Eigen::Isometry3d& view_from_place) const;

  double focal_baseline_;  // px m
  double bearing_sigma_rad_;
  double offset_px_ = 0.0;
  double variance_px2_;
  std::optional<Place> place_;
};

}  // namespace panvo::stereo_places

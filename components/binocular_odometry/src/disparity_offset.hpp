// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "panvo/binocular_odometry/tracked_frame.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::binocular_odometry {

/// Common error of all disparities (px), caused by a residual rotation between the cameras. Static points move in
/// proportion to their true disparity, so near and far points reveal the offset while the camera moves. One-state
/// Kalman filter, estimated together with the motion between two frames.
class DisparityOffset {
 public:
  static constexpr double kMaxOffset_px = 2.0;  ///< more indicates a wrong calibration

  double px() const noexcept { return px_; }

  /// Subtracts the offset from the disparity of (u, v, d).
  Eigen::Vector3d without(const Eigen::Vector3d& pixel) const { return pixel - Eigen::Vector3d(0.0, 0.0, px_); }

  /// Updates the offset from points with disparities in both frames; some of them may move. Returns the motion between
  /// the frames, refined together with the offset from the given initial motion.
  Eigen::Isometry3d learn(const vision::RectifiedStereo& stereo, std::span<const FramePair> points,
                          Eigen::Isometry3d current_from_previous);

 private:
  double px_ = 0.0;
  double variance_px2_ = kFirstSigma_px * kFirstSigma_px;

  static constexpr double kFirstSigma_px = 0.5;  // initial standard deviation
};

}  // namespace panvo::binocular_odometry

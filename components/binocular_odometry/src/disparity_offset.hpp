// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "panvo/binocular_odometry/tracked_frame.hpp"
#include "panvo/vision/camera.hpp"

namespace panvo::binocular_odometry {

/// One point, seen in a frame and in the next.
struct SeenTwice {
  Observation previous;
  Observation current;
};

/// What all disparities are too large by (px): what the calibration of a real pair leaves of a turn of one camera against the other. Points that
/// are at rest move past in proportion to their true disparity, so that where the camera moves, near and far points tell of it: from pair of
/// frames to pair of frames one unknown that hardly changes, estimated along with the motion between them (a Kalman filter of one state).
class DisparityOffset {
 public:
  static constexpr double kLargest_px = 2.0;  ///< more is no remainder, but another calibration

  double px() const noexcept { return px_; }

  /// A disparity as it would be without the offset.
  Eigen::Vector3d without(const Eigen::Vector3d& pixel) const { return pixel - Eigen::Vector3d(0.0, 0.0, px_); }

  /// Learns from points that are seen in two frames, with disparities in both; some of them may move. Gives back the motion between the frames,
  /// refined together with the offset from a first idea of it.
  Eigen::Isometry3d learn(const vision::RectifiedStereo& stereo, std::span<const SeenTwice> points,
                          Eigen::Isometry3d current_from_previous);

 private:
  double px_ = 0.0;
  double variance_px2_ = kFirstSigma_px * kFirstSigma_px;

  static constexpr double kFirstSigma_px = 0.5;  // before anything was learned
};

}  // namespace panvo::binocular_odometry

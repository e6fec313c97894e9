// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "panvo/binocular_odometry/odometry_estimate.hpp"
#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/binocular_odometry/scene_point.hpp"
#include "panvo/binocular_odometry/tracked_frame.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::binocular_odometry {

/// Second stage of the odometry [Lu2015 3]: RANSAC with Horn's quaternion method, then two-stage local binocular bundle adjustment.
/// The result depends only on the sequence of tracked frames. Not thread-safe.
class MotionStage {
 public:
  /// Throws std::invalid_argument, listing each problem, for an invalid calibration.
  MotionStage(const vision::RectifiedStereo& stereo, const MotionParameters& parameters,
              vision::StageObserver* observer = nullptr);
  ~MotionStage();
  MotionStage(MotionStage&&) noexcept;
  MotionStage& operator=(MotionStage&&) noexcept;

  /// Pose and motion of the next frame. If the motion cannot be estimated, the pose is predicted with the last motion,
  /// marked unreliable with the reason, and its covariance grows; the next frame is matched with the last good frame.
  /// A late frame gets the last pose, marked unreliable, and has no effect on the next.
  OdometryEstimate estimate(const TrackedFrame& frame);

  /// Points of the last frame; empty if its motion could not be estimated.
  std::vector<ScenePoint> points() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::binocular_odometry

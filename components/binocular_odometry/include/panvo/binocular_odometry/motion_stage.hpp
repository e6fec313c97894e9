// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/binocular_odometry/odometry_estimate.hpp"
#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/binocular_odometry/tracked_frame.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::binocular_odometry {

/// Second stage of the odometry [Lu2015 3]: RANSAC with Horn's quaternion method, then two-stage local binocular bundle adjustment.
/// It depends on the tracked frames alone, and on their order. One object is for one thread at a time.
class MotionStage {
 public:
  /// Throws std::invalid_argument, naming each problem, for a calibration that cannot be used.
  MotionStage(const vision::RectifiedStereo& stereo, const MotionParameters& parameters,
              vision::StageObserver* observer = nullptr);
  ~MotionStage();
  MotionStage(MotionStage&&) noexcept;
  MotionStage& operator=(MotionStage&&) noexcept;

  /// Pose and motion of the next frame. A frame that cannot be solved is carried on by the last motion, said to be unreliable
  /// with the reason, and its covariance grows; the one after it is solved against the last good frame.
  OdometryEstimate estimate(const TrackedFrame& frame);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::binocular_odometry

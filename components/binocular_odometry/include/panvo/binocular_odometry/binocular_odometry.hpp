// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/binocular_odometry/motion_stage.hpp"
#include "panvo/binocular_odometry/tracking_stage.hpp"

namespace panvo::binocular_odometry {

/// Stereo visual odometry with two-stage local binocular bundle adjustment (TLBBA) [Lu2015 3]; runs both stages in
/// sequence. To run them in parallel, use TrackingStage and MotionStage on one thread each; the results are the same.
class BinocularOdometry {
 public:
  /// Throws std::invalid_argument, listing each problem, for an invalid calibration or invalid parameters.
  BinocularOdometry(const vision::RectifiedStereo& stereo, const Parameters& parameters,
                    vision::StageObserver* observer = nullptr)
      : tracking_(stereo, parameters, observer), motion_(stereo, parameters.motion, observer) {}

  /// Processes frames in order of their stamps. For bad frames, the estimate is marked unreliable, with the reason.
  OdometryEstimate step(const StereoFrame& frame) { return motion_.estimate(tracking_.track(frame)); }

 private:
  TrackingStage tracking_;
  MotionStage motion_;
};

}  // namespace panvo::binocular_odometry

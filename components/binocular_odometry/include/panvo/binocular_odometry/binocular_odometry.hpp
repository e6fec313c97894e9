// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/binocular_odometry/motion_stage.hpp"
#include "panvo/binocular_odometry/tracking_stage.hpp"

namespace panvo::binocular_odometry {

/// Stereo visual odometry with two-stage local binocular bundle adjustment (TLBBA) [Lu2015 3]: both stages in turn.
/// To run them in parallel, use TrackingStage and MotionStage themselves on a thread each; the results are the same.
class BinocularOdometry {
 public:
  /// Throws std::invalid_argument, naming each problem, for a calibration or parameters that cannot be used.
  BinocularOdometry(const vision::RectifiedStereo& stereo, const Parameters& parameters,
                    vision::StageObserver* observer = nullptr)
      : tracking_(stereo, parameters.tracking, observer), motion_(stereo, parameters.motion, observer) {}

  /// Frames in order of their stamps; bad ones come back unreliable, with the reason.
  OdometryEstimate step(const StereoFrame& frame) { return motion_.estimate(tracking_.track(frame)); }

 private:
  TrackingStage tracking_;
  MotionStage motion_;
};

}  // namespace panvo::binocular_odometry

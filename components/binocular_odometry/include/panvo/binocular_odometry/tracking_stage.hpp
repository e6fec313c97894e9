// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/binocular_odometry/stereo_frame.hpp"
#include "panvo/binocular_odometry/tracked_frame.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::binocular_odometry {

/// First stage of the odometry [Lu2015 3]: detects and describes features, tracks them over time and matches left and
/// right image.
///
/// It predicts feature positions from its own coarse motion estimate and does not use results of the motion stage. The
/// two stages therefore give bit-identical results in sequence or on two threads with a queue in between. Not
/// thread-safe.
class TrackingStage {
 public:
  /// Throws std::invalid_argument, listing each problem, for an invalid calibration or invalid parameters.
  /// Uses the RANSAC parameters of the motion stage, too.
  TrackingStage(const vision::RectifiedStereo& stereo, const Parameters& parameters,
                vision::StageObserver* observer = nullptr);
  ~TrackingStage();
  TrackingStage(TrackingStage&&) noexcept;
  TrackingStage& operator=(TrackingStage&&) noexcept;

  /// Tracks into the next frame. An unusable frame (size, stamp, no content, left and right swapped) is returned with
  /// `fault` set and has no effect on the next frames, which are tracked from the last good one. Of a bad frame only the
  /// stamp and the pixels are kept, to recognise a stamp that goes back and an image that repeats.
  TrackedFrame track(const StereoFrame& frame);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::binocular_odometry

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/binocular_odometry/stereo_frame.hpp"
#include "panvo/binocular_odometry/tracked_frame.hpp"
#include "panvo/vision/camera.hpp"
#include "panvo/vision/stage_observer.hpp"

namespace panvo::binocular_odometry {

/// First stage of the odometry [Lu2015 3]: detects and describes features, matches them in time and between the two eyes.
///
/// It reads nothing that the motion stage finds: where features should reappear it foretells from a coarse motion of its
/// own. So the two stages give the same results, bit for bit, whether they work in turn or on two threads with a queue
/// between. One object is for one thread at a time.
class TrackingStage {
 public:
  /// Throws std::invalid_argument, naming each problem, for a calibration or parameters that cannot be used.
  TrackingStage(const vision::RectifiedStereo& stereo, const TrackingParameters& parameters,
                vision::StageObserver* observer = nullptr);
  ~TrackingStage();
  TrackingStage(TrackingStage&&) noexcept;
  TrackingStage& operator=(TrackingStage&&) noexcept;

  /// Tracks into the next frame. A frame that cannot be used (size, stamp, no content, left and right exchanged) comes back
  /// with its fault named and changes nothing: the next one is tracked from the last good one.
  TrackedFrame track(const StereoFrame& frame);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace panvo::binocular_odometry

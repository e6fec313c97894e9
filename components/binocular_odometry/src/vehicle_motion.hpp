// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "panvo/binocular_odometry/base_motion.hpp"
#include "panvo/binocular_odometry/motion_stage.hpp"

namespace panvo::binocular_odometry {

/// The cameras and where they are mounted.
struct StereoRig {
  vision::RectifiedStereo stereo;
  Eigen::Isometry3d base_from_left = Eigen::Isometry3d::Identity();  ///< the rectified left camera on the vehicle
};

/// A tracked frame with the rig that saw it.
struct RigFrame {
  TrackedFrame frame;
  std::shared_ptr<const StereoRig> rig;
};

/// Motion of the vehicle since the previous frame, and its pose.
struct VehicleEstimate {
  OdometryEstimate of_left;  ///< stamp and quality; poses of the left camera
  UncertainPose odom_from_base;
  UncertainPose previous_from_current;
};

/// Motion stage of a vehicle whose rig may change while it drives. Tracks of different rigs cannot be compared: the
/// path continues where the last motion leads until the new rig can start, unreliable as over a gap.
class VehicleMotion {
 public:
  explicit VehicleMotion(const MotionParameters& parameters, vision::StageObserver* observer = nullptr)
      : parameters_(parameters), observer_(observer) {}

  VehicleEstimate estimate(const RigFrame& seen);

  /// Points of the last frame, see MotionStage::points(), in the axes of its rig's start.
  std::vector<ScenePoint> points() const { return current_->stage.points(); }
  /// Pose in which the left camera of the current rig started. Precondition: there was a frame.
  Eigen::Isometry3d odom_from_start() const {
    const auto& mount = current_->rig->base_from_left;
    return current_->odom_from_start ? current_->odom_from_start->pose * mount : mount;
  }

 private:
  struct Leg {
    std::shared_ptr<const StereoRig> rig;
    MotionStage stage;
    std::optional<UncertainPose> odom_from_start{};  // of the vehicle; nullopt: the first leg, which starts in odom
  };

  Leg leg_of(const std::shared_ptr<const StereoRig>& rig) const;
  static VehicleEstimate on_vehicle(const Leg& leg, OdometryEstimate estimate);

  MotionParameters parameters_;
  vision::StageObserver* observer_;
  std::optional<Leg> current_;
  std::optional<Leg> next_;  // of a new rig, until it has started
};

}  // namespace panvo::binocular_odometry

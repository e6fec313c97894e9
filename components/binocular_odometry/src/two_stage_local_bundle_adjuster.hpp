// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "bundle_solver.hpp"
#include "panvo/binocular_odometry/parameters.hpp"
#include "panvo/binocular_odometry/scene_point.hpp"
#include "panvo/binocular_odometry/tracked_frame.hpp"

namespace panvo::binocular_odometry {

/// A frame of the adjustment window.
struct Keyframe {
  Eigen::Isometry3d left_from_odom = Eigen::Isometry3d::Identity();
  std::vector<Observation> observations;  ///< ascending track_id
};

/// A measured motion; its covariance is that of the error in exp(error) * current_from_previous.
struct MeasuredMotion {
  Eigen::Isometry3d current_from_previous = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  double residual_px = 0.0;
};

/// Our definition of TLBBA. [Lu2015 3] cites a 2013 paper for it and only states that it has two stages and uses both
/// cameras. Stage one adjusts the motion between two frames and the points seen in both, by reprojection into both
/// cameras of both frames. Stage two adjusts poses and points of the last keyframes and the current frame; the oldest
/// keyframes are fixed.
class TwoStageLocalBundleAdjuster {
 public:
  TwoStageLocalBundleAdjuster(const vision::RectifiedStereo& stereo, const MotionParameters& parameters)
      : stereo_(stereo), parameters_(parameters) {}

  /// Stage one: observations of the same points in two frames (spans of equal length), and an initial motion.
  MeasuredMotion refine_motion(std::span<const Observation> previous, std::span<const Observation> current,
                               const Eigen::Isometry3d& current_from_previous) const;

  /// Stage two: adjusts the keyframes and points of the window and the pose of `head`, the current frame, and removes
  /// outlier observations from all of them. Returns the motion from the last keyframe to the head; nullopt if the head
  /// shares too few points with the window.
  std::optional<MeasuredMotion> refine_window(Keyframe& head, int max_iterations);

  /// Adds a keyframe: its new tracks become points of the window; removes the oldest keyframe of a full window.
  void add_keyframe(Keyframe frame);

  /// Removes all keyframes and points.
  void clear();

  /// Current estimate of the offset to subtract from measured disparities (px); see BundleProblem.
  double disparity_offset_px() const { return disparity_offset_px_; }
  /// Adds an externally estimated change of the offset.
  void move_disparity_offset(double by_px) { disparity_offset_px_ += by_px; }

  /// Number of keyframes in which a static point was observed, 0 if none; nullopt for a point that contradicts the
  /// camera motion.
  std::optional<int> standing(std::int64_t track_id) const;

  /// An observed point, with its adjusted position if it is one of the window. `odom_from_left`: pose of the observing
  /// frame.
  ScenePoint scene_point(const Observation& seen, const Eigen::Isometry3d& odom_from_left) const;

  bool is_empty() const { return keyframes_.empty(); }
  const Keyframe& last_keyframe() const { return keyframes_.back(); }

 private:
  struct WindowPoint {
    BundlePoint point;
    int keyframes = 0;  ///< number of keyframes that observe it
    int contradictions = 0;
    bool is_refuted = false;  ///< contradicts the camera motion: on a moving object, or mismatched
  };

  Eigen::Vector3d point_of(const Observation& seen) const;
  BundleProblem assemble(const Keyframe& head, std::vector<std::int64_t>& ids) const;
  void forget_unseen_points();

  vision::RectifiedStereo stereo_;
  MotionParameters parameters_;
  std::deque<Keyframe> keyframes_;
  std::map<std::int64_t, WindowPoint> points_;
  double disparity_offset_px_ = 0.0;
};

}  // namespace panvo::binocular_odometry

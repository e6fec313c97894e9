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
#include "panvo/binocular_odometry/tracked_frame.hpp"

namespace panvo::binocular_odometry {

/// A frame that the window keeps.
struct Keyframe {
  Eigen::Isometry3d left_from_odom = Eigen::Isometry3d::Identity();
  std::vector<Observation> observations;  ///< ascending track_id
};

/// A measured motion and its uncertainty, as exp(error) * current_from_previous.
struct MeasuredMotion {
  Eigen::Isometry3d current_from_previous = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance = vision::Matrix6d::Zero();
  double residual_px = 0.0;
};

/// TLBBA as we define it. [Lu2015 3] names it and cites a 2013 paper; what it says of it is the two stages and that both eyes count.
/// Stage one: the motion between two frames and the points seen in both, by their reprojection into both cameras of both
/// frames. Stage two: the last keyframes and the frame at hand, poses and points together; the oldest keyframes stay fixed
/// and hold the others.
class TwoStageLocalBundleAdjuster {
 public:
  TwoStageLocalBundleAdjuster(const vision::RectifiedStereo& stereo, const MotionParameters& parameters)
      : stereo_(stereo), parameters_(parameters) {}

  /// Stage one, over observations of the same points in two frames (spans of equal length), from a first guess.
  MeasuredMotion refine_motion(std::span<const Observation> previous, std::span<const Observation> current,
                               const Eigen::Isometry3d& current_from_previous) const;

  /// Stage two: improves the window's keyframes and points and the pose of `head`, the frame at hand; takes observations
  /// that contradict the rest out of all of them. Returns the motion from the last keyframe to the head;
  /// nullopt when the head sees too little of the window.
  std::optional<MeasuredMotion> refine_window(Keyframe& head, int max_iterations);

  /// Makes the frame a keyframe: its new tracks become points of the window, the oldest keyframe leaves.
  void add_keyframe(Keyframe frame);

  /// Forgets everything: the next keyframe starts a new window.
  void clear();

  /// What to take off a measured disparity, as far as it is known by now (px); see BundleProblem.
  double disparity_offset_px() const { return disparity_offset_px_; }
  /// Others have learned that it is so much larger.
  void move_disparity_offset(double by_px) { disparity_offset_px_ += by_px; }

  /// In how many keyframes a point was seen, standing still as the window has it; 0 for one that is in none. nullopt for a point that
  /// contradicts the camera's motion.
  std::optional<int> standing(std::int64_t track_id) const;

  bool is_empty() const { return keyframes_.empty(); }
  const Keyframe& last_keyframe() const { return keyframes_.back(); }

 private:
  struct WindowPoint {
    BundlePoint point;
    int keyframes = 0;  ///< that saw it
    int contradictions = 0;
    bool is_refuted = false;  ///< contradicts the camera's motion: on something that moves, or mismatched
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

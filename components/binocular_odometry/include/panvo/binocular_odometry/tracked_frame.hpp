// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace panvo::binocular_odometry {

/// Observation of a scene point in one frame; observations of the same point share a track_id.
struct Observation {
  std::int64_t track_id = 0;
  Eigen::Vector3d pixel = Eigen::Vector3d::Zero();  ///< u, v in the left image, and disparity (px)
  bool has_disparity = false;                       ///< also found in the right image; else pixel.z() is invalid
  double sigma_px = 1.0;                            ///< standard deviation of u and of v
  double sigma_disparity_px = 1.0;                  ///< standard deviation of the disparity
};

/// Observations of one point in two consecutive frames.
struct FramePair {
  Observation previous;
  Observation current;
};

/// Output of the tracking stage, input of the motion stage.
struct TrackedFrame {
  std::int64_t stamp_ns = 0;
  std::vector<Observation> observations;  ///< ascending track_id
  /// Points found in the last good frame and in this one by their descriptors, after a gap over which tracks could not
  /// be followed; mostly empty. Apart from the tracks, both disparities known; track_id is 0.
  std::vector<FramePair> matches;
  /// Motion between the last good frame and this one on which the tracks agree, to start from.
  std::optional<Eigen::Isometry3d> current_from_previous;
  int detected = 0;                  ///< features in this frame, new or tracked
  int tracked = 0;                   ///< of these, tracked from earlier frames
  int matched = 0;                   ///< of the detected ones, also found in the right image
  double row_misalignment_px = 0.0;  ///< current estimate of the largest row error of the right image
  double disparity_offset_px = 0.0;  ///< current estimate of the common disparity error; not subtracted
  std::string fault;                 ///< why the frame is unusable; empty if it is usable
  bool is_late = false;              ///< the fault is a stamp that is not later than those before
};

}  // namespace panvo::binocular_odometry

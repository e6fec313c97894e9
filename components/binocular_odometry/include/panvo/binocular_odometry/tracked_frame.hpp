// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace panvo::binocular_odometry {

/// A point of the scene as one frame sees it; the same track_id in other frames means the same point.
struct Observation {
  std::int64_t track_id = 0;
  Eigen::Vector3d pixel = Eigen::Vector3d::Zero();  ///< u, v in the left image, and disparity (px)
  bool has_disparity = false;                       ///< found in the right image too; else pixel.z() means nothing
  double sigma_px = 1.0;                            ///< standard deviation of u and of v
  double sigma_disparity_px = 1.0;                  ///< standard deviation of the disparity
};

/// What the tracking stage hands to the motion stage: the frame without its pixels.
struct TrackedFrame {
  std::int64_t stamp_ns = 0;
  std::vector<Observation> observations;  ///< ascending track_id
  int detected = 0;                       ///< features found in this frame, new or known
  int tracked = 0;                        ///< of these, known from before
  int matched = 0;                        ///< of all, found in the right image too
  double row_misalignment_px = 0.0;       ///< how far the right image's rows are off the left's, as learned by now
  double disparity_offset_px = 0.0;       ///< what all disparities are too large by, as learned by now; not taken off
  std::string fault;                      ///< why the frame cannot be used; empty when it can
};

}  // namespace panvo::binocular_odometry

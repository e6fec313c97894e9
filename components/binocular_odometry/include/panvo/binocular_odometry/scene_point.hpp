// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace panvo::binocular_odometry {

/// A point of the scene, as seen in the last frame. For display.
struct ScenePoint {
  enum class State : std::uint8_t {
    kNew = 0,      ///< seen in too few frames to be judged
    kInlier = 1,   ///< consistent with the camera motion
    kOutlier = 2,  ///< contradicts it: on a moving object, or mismatched
  };

  std::int64_t track_id = 0;                        ///< the same in all frames
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the left rectified image
  State state = State::kNew;
  std::optional<Eigen::Vector3d> in_odom;  ///< m, in the odom frame of OdometryEstimate; nullopt: unknown, or too far
};

}  // namespace panvo::binocular_odometry

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

/// Poses in one map and what was measured between them; finds the poses that contradict the measurements least.
class PoseGraph {
 public:
  /// `from` and `to`: poses; the measurement is from_from_to (pose of `to` in the axes of `from`), covariance as of vision::pose_error.
  struct Edge {
    std::size_t from = 0, to = 0;
    Eigen::Isometry3d from_from_to = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Identity();
    bool is_robust = false;  ///< may be wrong: a residual beyond a few standard deviations loses its pull (Cauchy)
  };
  /// What is known of a pose by itself: that of an earlier day's landmark, or of the start.
  struct Prior {
    std::size_t pose = 0;
    Eigen::Isometry3d map_from_pose = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Identity();
  };

  std::vector<Eigen::Isometry3d> poses;  ///< map_from_pose; to begin with about right
  std::vector<Edge> edges;
  std::vector<Prior> priors;

  /// Moves the poses to the minimum. Throws std::invalid_argument where an edge or prior names a pose that is not there, or a
  /// covariance is not positive definite. A pose without any edge or prior stays. False, and nothing is moved, where no minimum was found.
  bool optimise();

  /// Covariances of all poses in the map at the minimum, as of vision::pose_error; nullopt where the measurements do not
  /// determine them all.
  std::optional<std::vector<vision::Matrix6d>> covariances() const;
};

}  // namespace panvo::localizer

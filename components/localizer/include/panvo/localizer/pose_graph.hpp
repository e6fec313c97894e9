// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

#include "panvo/vision/pose.hpp"

namespace panvo::localizer {

/// Poses in one map and the measurements between them; finds the poses with the least squared error.
class PoseGraph {
 public:
  /// `from` and `to`: poses; the measurement is from_from_to (pose of `to` in the axes of `from`), covariance as
  /// vision::pose_error.
  struct Edge {
    std::size_t from = 0, to = 0;
    Eigen::Isometry3d from_from_to = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Identity();
    bool is_robust = false;  ///< may be an outlier: Cauchy loss on the residual
  };
  /// Prior of a single pose: a landmark of an earlier journey, or the start.
  struct Prior {
    std::size_t pose = 0;
    Eigen::Isometry3d map_from_pose = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Identity();
  };

  std::vector<Eigen::Isometry3d> poses;  ///< map_from_pose; initial values on input
  std::vector<Edge> edges;
  std::vector<Prior> priors;

  /// Moves the poses to the minimum. Throws std::invalid_argument if an edge or prior refers to a pose that does not
  /// exist or a covariance is not positive definite. A pose without edges and priors stays. Returns false, without
  /// effect, if no minimum was found.
  bool optimise();

  /// Covariances of all poses in the map at the minimum, as vision::pose_error; nullopt if the measurements do not
  /// determine all of them.
  std::optional<std::vector<vision::Matrix6d>> covariances() const;
};

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <utility>
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
    bool is_scaled = false;  ///< measured by the stereo camera: its translation is too long by the factor `scale`
  };
  /// Prior of a single pose: a landmark of an earlier journey, or the start.
  struct Prior {
    std::size_t pose = 0;
    Eigen::Isometry3d map_from_pose = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Identity();
  };

  /// Position of a point of a pose, in the axes of another pose, `frame`. May be an outlier: Cauchy loss.
  struct Fix {
    std::size_t frame = 0, pose = 0;
    Eigen::Vector3d point_in_pose = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity_in_pose = Eigen::Vector3d::Zero();  ///< of the point, per unit of `delay`
    Eigen::Vector3d point_in_frame = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  };

  std::vector<Eigen::Isometry3d> poses;  ///< map_from_pose; initial values on input
  std::vector<Edge> edges;
  std::vector<Prior> priors;
  std::vector<Fix> fixes;
  double scale = 1.0;  ///< of scaled edges: measured over true length; initial value on input
  double expected_scale = 1.0, scale_sigma = 0.0;  ///< its prior; 0: it stays
  double delay = 0.0;        ///< of the poses of all fixes after the point was there; initial value on input
  double delay_sigma = 0.0;  ///< its prior around 0; 0: it stays

  /// Moves the poses to the minimum. Throws std::invalid_argument if an edge or prior refers to a pose that does not
  /// exist or a covariance is not positive definite. A pose without edges and priors stays. Returns false, without
  /// effect, if no minimum was found.
  bool optimise();

  struct Covariances {
    std::vector<vision::Matrix6d> poses;  ///< of those asked for, in the map, as vision::pose_error
    /// Of the two poses that covariances() was asked for: rows of the first, columns of the second.
    vision::Matrix6d cross = vision::Matrix6d::Zero();
    double scale_variance = 0.0, delay_variance = 0.0;
  };
  /// At the minimum; nullopt if the measurements do not determine all of them. `of`: poses, without which all are meant;
  /// each costs in proportion to the size of the graph. `pair`: two poses whose errors are wanted together.
  std::optional<Covariances> covariances(const std::vector<std::size_t>& of = {},
                                         std::optional<std::pair<std::size_t, std::size_t>> pair = {}) const;
};

}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "panvo/simulated_world/random.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::simulation {

/// Error model of an odometry: errors that are constant over a distance and then drawn again independently, and
/// constant errors.
struct DriftParameters {
  double motion_error_ratio = 0.012;       ///< standard deviation of the distance, relative, over `persistence_m`
  double rotation_error_rad_per_m = 3e-4;  ///< standard deviation of the rotation
  double persistence_m = 5.0;
  double scale_error = 0.0;          ///< constant; 0.01: distances are 1 % too long
  double yaw_error_rad_per_m = 0.0;  ///< constant, left positive

  template <class Field>
  static void describe(Field&& field) {
    using P = DriftParameters;
    field(&P::motion_error_ratio, "motion_error_ratio", "1",
          "standard deviation of the distance, relative, over persistence_m", 0.0, 1.0);
    field(&P::rotation_error_rad_per_m, "rotation_error_rad_per_m", "rad/m", "standard deviation of the rotation", 0.0,
          1.0);
    field(&P::persistence_m, "persistence_m", "m", "distance after which an error is replaced by an independent one",
          0.01, 1000.0);
    field(&P::scale_error, "scale_error", "1", "constant, not in the covariance; 0.01: distances are 1 % too long",
          -0.5, 0.5);
    field(&P::yaw_error_rad_per_m, "yaw_error_rad_per_m", "rad/m", "constant, not in the covariance; left positive",
          -0.1, 0.1);
  }
};

/// Simulates an odometry by adding drift to the ground truth, to test drift correction repeatedly on journeys rendered
/// with panoramas only.
class DriftingOdometry {
 public:
  struct Pose {
    Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< order as in vision::pose_error
  };

  DriftingOdometry(const DriftParameters& parameters, std::uint64_t seed);

  /// Advances to the next true pose; the first one is the origin of odom.
  Pose step(const Eigen::Isometry3d& true_world_from_base);

 private:
  vision::Vector6d noise();

  const DriftParameters parameters_;
  simulated_world::Random random_;
  vision::Vector6d persisting_;  // current errors, in standard deviations
  double since_change_m_ = 0.0;
  std::optional<Eigen::Isometry3d> last_truth_;
  Pose pose_;
};

}  // namespace panvo::simulation

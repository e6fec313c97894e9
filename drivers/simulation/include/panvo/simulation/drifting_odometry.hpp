// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "panvo/simulation/random.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::simulation {

/// How an odometry errs: steps of independent errors, each as long as an error persists, and what is the same all the way.
struct DriftParameters {
  double motion_error_ratio = 0.012;       ///< standard deviation of the way, of the way, over `persistence_m`
  double rotation_error_rad_per_m = 3e-4;  ///< and of the rotation
  double persistence_m = 5.0;
  double scale_error = 0.0;          ///< constant: 0.01 is a hundredth too long
  double yaw_error_rad_per_m = 0.0;  ///< constant, left positive

  template <class Field>
  static void describe(Field&& field) {
    using P = DriftParameters;
    field(&P::motion_error_ratio, "motion_error_ratio", "1",
          "standard deviation of a way, as a share of it, over persistence_m", 0.0, 1.0);
    field(&P::rotation_error_rad_per_m, "rotation_error_rad_per_m", "rad/m", "the same of the rotation", 0.0, 1.0);
    field(&P::persistence_m, "persistence_m", "m", "how long an error persists before another, independent one follows",
          0.01, 1000.0);
    field(&P::scale_error, "scale_error", "1", "constant, and not in the covariance: 0.01 is a hundredth too long",
          -0.5, 0.5);
    field(&P::yaw_error_rad_per_m, "yaw_error_rad_per_m", "rad/m", "constant, and not in the covariance; left positive",
          -0.1, 0.1);
  }
};

/// An odometry made of the truth and a drift: to try what corrects drift on journeys of which there are panoramas only, many
/// times over.
class DriftingOdometry {
 public:
  struct Pose {
    Eigen::Isometry3d odom_from_base = Eigen::Isometry3d::Identity();
    vision::Matrix6d covariance = vision::Matrix6d::Zero();  ///< as of vision::pose_error
  };

  DriftingOdometry(const DriftParameters& parameters, std::uint64_t seed);

  /// The first pose is where odom begins.
  Pose step(const Eigen::Isometry3d& true_world_from_base);

 private:
  vision::Vector6d noise();

  const DriftParameters parameters_;
  Random random_;
  vision::Vector6d persisting_;  // errors of this stretch, in standard deviations
  double since_change_m_ = 0.0;
  std::optional<Eigen::Isometry3d> last_truth_;
  Pose pose_;
};

}  // namespace panvo::simulation

// SPDX-License-Identifier: Apache-2.0
#include "panvo/binocular_odometry/base_motion.hpp"

namespace panvo::binocular_odometry {

UncertainPose motion_of_base(const Eigen::Isometry3d& base_from_left, const Eigen::Isometry3d& motion_of_left,
                             const vision::Matrix6d& covariance) {
  const vision::Matrix6d exact = vision::Matrix6d::Zero();
  const Eigen::Isometry3d base_from_moved_left = base_from_left * motion_of_left;
  const vision::Matrix6d moved_covariance =
      vision::compose_covariance(base_from_left, exact, motion_of_left, covariance);
  const Eigen::Isometry3d left_from_base = base_from_left.inverse();
  return {base_from_moved_left * left_from_base,
          vision::compose_covariance(base_from_moved_left, moved_covariance, left_from_base, exact)};
}

}  // namespace panvo::binocular_odometry

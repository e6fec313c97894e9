// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/step_covariance.hpp"

#include <Eigen/Eigenvalues>

namespace panvo::vision {

Matrix6d step_covariance(const Eigen::Isometry3d& odom_from_a, const Matrix6d& covariance_a,
                         const Eigen::Isometry3d& odom_from_b, const Matrix6d& covariance_b, double min_variance) {
  const Eigen::Isometry3d a_from_b = odom_from_a.inverse() * odom_from_b;
  const Matrix6d inherited = compose_covariance(odom_from_a, covariance_a, a_from_b, Matrix6d::Zero());
  const Matrix6d difference = rotate_covariance(odom_from_a.linear().transpose(), covariance_b - inherited);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> parts(0.5 * (difference + difference.transpose()));
  return parts.eigenvectors() * parts.eigenvalues().cwiseMax(min_variance).asDiagonal() *
         parts.eigenvectors().transpose();
}

Matrix6d after_unknown_motion(const Matrix6d& covariance, const Vector6d& twist, double time_s) {
  Matrix6d after = covariance;
  after.diagonal().head<3>().array() += (time_s * twist.head<3>()).squaredNorm();
  after.diagonal().tail<3>().array() += (time_s * twist.tail<3>()).squaredNorm();
  return after;
}

}  // namespace panvo::vision

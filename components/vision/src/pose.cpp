// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/pose.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace panvo::vision {
namespace {

constexpr double kSmallAngle = 1e-5;  // below, the next series term is under 1e-20

// Left Jacobian of SO(3): maps the linear part of a twist to the translation.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  const Eigen::Matrix3d w = skew(rotation_rad);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * w + w * w / 6.0;
  const double angle2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle2 * w +
         (angle - std::sin(angle)) / (angle2 * angle) * w * w;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  const Eigen::Matrix3d w = skew(rotation_rad);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + w + 0.5 * w * w;
  return Eigen::Matrix3d::Identity() + std::sin(angle) / angle * w + (1.0 - std::cos(angle)) / (angle * angle) * w * w;
}

Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation) {
  // Via the quaternion: well conditioned at every angle, including pi.
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < kSmallAngle) return 2.0 * q.vec() / q.w();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Eigen::Isometry3d se3_exp(const Vector6d& twist) {
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = so3_exp(twist.tail<3>());
  a_from_b.translation() = left_jacobian(twist.tail<3>()) * twist.head<3>();
  return a_from_b;
}

Vector6d se3_log(const Eigen::Isometry3d& a_from_b) {
  Vector6d twist;
  twist.tail<3>() = so3_log(a_from_b.linear());
  twist.head<3>() = left_jacobian(twist.tail<3>()).inverse() * a_from_b.translation();
  return twist;
}

Eigen::Isometry3d interpolate(const Eigen::Isometry3d& a_from_b, const Eigen::Isometry3d& a_from_c, double share) {
  return a_from_b * se3_exp(share * se3_log(a_from_b.inverse() * a_from_c));
}

Matrix6d adjoint(const Eigen::Isometry3d& a_from_b) {
  Matrix6d matrix = Matrix6d::Zero();
  matrix.topLeftCorner<3, 3>() = a_from_b.linear();
  matrix.topRightCorner<3, 3>() = skew(a_from_b.translation()) * a_from_b.linear();
  matrix.bottomRightCorner<3, 3>() = a_from_b.linear();
  return matrix;
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Vector6d pose_error(const Eigen::Isometry3d& estimated_a_from_b, const Eigen::Isometry3d& true_a_from_b) {
  Vector6d error;
  error.head<3>() = true_a_from_b.translation() - estimated_a_from_b.translation();
  error.tail<3>() = so3_log(true_a_from_b.linear() * estimated_a_from_b.linear().transpose());
  return error;
}

Matrix6d compose_covariance(const Eigen::Isometry3d& a_from_b, const Matrix6d& covariance_a_from_b,
                            const Eigen::Isometry3d& b_from_c, const Matrix6d& covariance_b_from_c) {
  // t_ac = t_ab + R_ab t_bc: an error of R_ab acts on the lever arm from b to c.
  Matrix6d by_first = Matrix6d::Identity();
  by_first.topRightCorner<3, 3>() = -skew(a_from_b.linear() * b_from_c.translation());
  Matrix6d by_second = Matrix6d::Zero();
  by_second.topLeftCorner<3, 3>() = a_from_b.linear();
  by_second.bottomRightCorner<3, 3>() = a_from_b.linear();
  return by_first * covariance_a_from_b * by_first.transpose() +
         by_second * covariance_b_from_c * by_second.transpose();
}

Matrix6d rotate_covariance(const Eigen::Matrix3d& b_from_a, const Matrix6d& covariance) {
  Matrix6d rotation = Matrix6d::Zero();
  rotation.topLeftCorner<3, 3>() = b_from_a;
  rotation.bottomRightCorner<3, 3>() = b_from_a;
  return rotation * covariance * rotation.transpose();
}

Matrix6d stamp_covariance(const Eigen::Isometry3d& a_from_b, const Vector6d& twist, double sigma_s) {
  Vector6d moved;
  moved << a_from_b.linear() * twist.head<3>(), a_from_b.linear() * twist.tail<3>();
  return sigma_s * sigma_s * moved * moved.transpose();
}

double horizontal_sigma(const Matrix6d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(covariance.topLeftCorner<2, 2>());
  return std::sqrt(std::max(0.0, spread.eigenvalues().maxCoeff()));
}

Matrix6d invert_covariance(const Eigen::Isometry3d& a_from_b, const Matrix6d& covariance_a_from_b) {
  // t_ba = -R_ab^T t_ab and R_ba = R_ab^T, to first order in the errors of a_from_b.
  const Eigen::Matrix3d b_from_a = a_from_b.linear().transpose();
  Matrix6d by_inverse = Matrix6d::Zero();
  by_inverse.topLeftCorner<3, 3>() = -b_from_a;
  by_inverse.topRightCorner<3, 3>() = -b_from_a * skew(a_from_b.translation());
  by_inverse.bottomRightCorner<3, 3>() = -b_from_a;
  return by_inverse * covariance_a_from_b * by_inverse.transpose();
}

}  // namespace panvo::vision

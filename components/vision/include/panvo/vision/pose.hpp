// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

/// Rigid motions and their uncertainty. A pose `a_from_b` takes coordinates in frame b to coordinates in frame a; six-vectors
/// hold translation first, then rotation, as in the covariance of geometry_msgs/PoseWithCovariance.
namespace panvo::vision {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Cross-product matrix: skew(v) * w == v.cross(w).
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation by an axis-angle vector (rad), and back (angle in [0, pi]).
Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation_rad);
Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation);

/// Rigid motion of a constant twist (m, rad) held for one unit of time, and back.
Eigen::Isometry3d se3_exp(const Vector6d& twist);
Vector6d se3_log(const Eigen::Isometry3d& a_from_b);

/// Takes a twist in frame b to the same twist in frame a.
Matrix6d adjoint(const Eigen::Isometry3d& a_from_b);

/// Nearest proper rotation (smallest Frobenius distance): undoes the rounding of many products.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

/// The pose at `share` [0, 1] of the way from one to another, at constant twist.
Eigen::Isometry3d interpolate(const Eigen::Isometry3d& a_from_b, const Eigen::Isometry3d& a_from_c, double share);

/// Error of an estimated pose, the quantity whose covariance every pose of panvo carries: the translation t_true - t_estimate
/// (m) and the rotation vector of R_true * R_estimate^T (rad), both in the axes of the parent frame a.
Vector6d pose_error(const Eigen::Isometry3d& estimated_a_from_b, const Eigen::Isometry3d& true_a_from_b);

/// Covariance of a_from_c = a_from_b * b_from_c for independent errors of the two (each as of pose_error).
Matrix6d compose_covariance(const Eigen::Isometry3d& a_from_b, const Matrix6d& covariance_a_from_b,
                            const Eigen::Isometry3d& b_from_c, const Matrix6d& covariance_b_from_c);

/// A covariance in the axes of frame a, in those of frame b.
Matrix6d rotate_covariance(const Eigen::Matrix3d& b_from_a, const Matrix6d& covariance);

/// What an uncertain stamp (standard deviation `sigma_s`) adds to the covariance of a_from_b while b moves by `twist` (m/s and rad/s, in its
/// own axes): where it is by then is not where it was.
Matrix6d stamp_covariance(const Eigen::Isometry3d& a_from_b, const Vector6d& twist, double sigma_s);

/// Standard deviation of the horizontal position along its worst direction, m.
double horizontal_sigma(const Matrix6d& covariance);

/// Covariance of b_from_a, given that of a_from_b.
Matrix6d invert_covariance(const Eigen::Isometry3d& a_from_b, const Matrix6d& covariance_a_from_b);

}  // namespace panvo::vision

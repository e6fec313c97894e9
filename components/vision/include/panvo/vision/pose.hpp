// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

/// Rigid motions and their uncertainty. A pose `a_from_b` maps coordinates in frame b to frame a. Six-vectors hold
/// translation, then rotation, as in the covariance of geometry_msgs/PoseWithCovariance.
namespace panvo::vision {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
inline constexpr int kYaw = 5;  ///< index of the rotation about z in a six-vector

/// Cross-product matrix: skew(v) * w == v.cross(w).
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation from an axis-angle vector (rad), and its inverse (angle in [0, pi]).
Eigen::Matrix3d so3_exp(const Eigen::Vector3d& rotation_rad);
Eigen::Vector3d so3_log(const Eigen::Matrix3d& rotation);

/// Rigid motion of a constant twist (m, rad) over one unit of time, and its inverse.
Eigen::Isometry3d se3_exp(const Vector6d& twist);
Vector6d se3_log(const Eigen::Isometry3d& a_from_b);

/// Maps a twist from frame b to frame a.
Matrix6d adjoint(const Eigen::Isometry3d& a_from_b);

/// Nearest proper rotation (Frobenius norm); removes accumulated rounding errors.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

/// Interpolates between two poses at constant twist; `share` in [0, 1].
Eigen::Isometry3d interpolate(const Eigen::Isometry3d& a_from_b, const Eigen::Isometry3d& a_from_c, double share);

/// Error of an estimated pose, as described by all pose covariances of panvo: translation t_true - t_estimate (m) and
/// rotation vector of R_true * R_estimate^T (rad), both in the axes of the parent frame a.
Vector6d pose_error(const Eigen::Isometry3d& estimated_a_from_b, const Eigen::Isometry3d& true_a_from_b);

/// Covariance of a_from_c = a_from_b * b_from_c for independent errors, each as defined by pose_error().
Matrix6d compose_covariance(const Eigen::Isometry3d& a_from_b, const Matrix6d& covariance_a_from_b,
                            const Eigen::Isometry3d& b_from_c, const Matrix6d& covariance_b_from_c);

/// Rotates a covariance from the axes of frame a to those of frame b.
Matrix6d rotate_covariance(const Eigen::Matrix3d& b_from_a, const Matrix6d& covariance);

/// Contribution of an uncertain stamp (standard deviation `sigma_s`) to the covariance of a_from_b while b moves with
/// `twist` (m/s and rad/s, in the axes of b).
Matrix6d stamp_covariance(const Eigen::Isometry3d& a_from_b, const Vector6d& twist, double sigma_s);

/// Largest standard deviation of the horizontal position over all directions, m.
double horizontal_sigma(const Matrix6d& covariance);

/// Covariance of b_from_a from that of a_from_b.
Matrix6d invert_covariance(const Eigen::Isometry3d& a_from_b, const Matrix6d& covariance_a_from_b);

}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/pose.hpp"

#include <fmt/format.h>

#include <cmath>

namespace panvo::conversions {
namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// The quaternion with w >= 0 of the two of a rotation, so that equal rotations give equal messages.
geometry_msgs::msg::Quaternion to_quaternion(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  geometry_msgs::msg::Quaternion message;
  message.x(q.x());
  message.y(q.y());
  message.z(q.z());
  message.w(q.w());
  return message;
}

template <class Translation>
Result<Eigen::Isometry3d> isometry(const Translation& t, const geometry_msgs::msg::Quaternion& rotation) {
  const Eigen::Vector3d translation(t.x(), t.y(), t.z());
  const Eigen::Quaterniond quaternion(rotation.w(), rotation.x(), rotation.y(), rotation.z());
  if (!translation.allFinite() || !quaternion.coeffs().allFinite()) return Reason{"holds a value that is not a number"};
  constexpr double kTolerance = 1e-3;
  if (std::abs(quaternion.norm() - 1.0) > kTolerance) {
    return Reason{fmt::format("has a rotation quaternion of length {:.3g} where 1 is needed", quaternion.norm())};
  }
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = quaternion.normalized().toRotationMatrix();
  a_from_b.translation() = translation;
  return a_from_b;
}

}  // namespace

geometry_msgs::msg::Vector3 to_vector3(const Eigen::Vector3d& vector) {
  geometry_msgs::msg::Vector3 message;
  message.x(vector.x());
  message.y(vector.y());
  message.z(vector.z());
  return message;
}

Eigen::Vector3d to_eigen(const geometry_msgs::msg::Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

geometry_msgs::msg::Pose to_pose(const Eigen::Isometry3d& a_from_b) {
  geometry_msgs::msg::Pose pose;
  pose.position().x(a_from_b.translation().x());
  pose.position().y(a_from_b.translation().y());
  pose.position().z(a_from_b.translation().z());
  pose.orientation(to_quaternion(a_from_b.linear()));
  return pose;
}

geometry_msgs::msg::Transform to_transform(const Eigen::Isometry3d& parent_from_child) {
  geometry_msgs::msg::Transform transform;
  transform.translation().x(parent_from_child.translation().x());
  transform.translation().y(parent_from_child.translation().y());
  transform.translation().z(parent_from_child.translation().z());
  transform.rotation(to_quaternion(parent_from_child.linear()));
  return transform;
}

Result<Eigen::Isometry3d> to_isometry(const geometry_msgs::msg::Pose& pose) {
  return isometry(pose.position(), pose.orientation());
}

Result<Eigen::Isometry3d> to_isometry(const geometry_msgs::msg::Transform& transform) {
  return isometry(transform.translation(), transform.rotation());
}

std::array<double, 36> to_array(const vision::Matrix6d& covariance) {
  std::array<double, 36> values;
  Eigen::Map<RowMajor6d>(values.data()) = covariance;
  return values;
}

vision::Matrix6d to_matrix(const std::array<double, 36>& covariance) {
  return Eigen::Map<const RowMajor6d>(covariance.data());
}

}  // namespace panvo::conversions

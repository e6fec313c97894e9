// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/absolute_orientation.hpp"

#include <Eigen/Eigenvalues>

namespace panvo::vision {
namespace {
constexpr double kMinGap = 1e-6;  // relative, between the two largest eigenvalues; below, the points are collinear
}

std::optional<Eigen::Isometry3d> absolute_orientation(std::span<const Eigen::Vector3d> points_in_a,
                                                      std::span<const Eigen::Vector3d> points_in_b) {
  const size_t count = points_in_a.size();
  if (count < 3 || points_in_b.size() != count) return std::nullopt;
  Eigen::Vector3d centre_a = Eigen::Vector3d::Zero(), centre_b = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < count; ++i) {
    centre_a += points_in_a[i];
    centre_b += points_in_b[i];
  }
  centre_a /= static_cast<double>(count);
  centre_b /= static_cast<double>(count);

  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();  // cross-covariance of b and a
  for (size_t i = 0; i < count; ++i) s += (points_in_b[i] - centre_b) * (points_in_a[i] - centre_a).transpose();

  Eigen::Matrix4d n;
  n << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),  //
      s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),   //
      s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),   //
      s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(n);
  const Eigen::Vector4d& eigenvalues = solver.eigenvalues();  // ascending
  if (!(eigenvalues(3) - eigenvalues(2) > kMinGap * eigenvalues(3))) return std::nullopt;
  const Eigen::Vector4d q = solver.eigenvectors().col(3);

  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized().toRotationMatrix();
  a_from_b.translation() = centre_a - a_from_b.linear() * centre_b;
  return a_from_b;
}

}  // namespace panvo::vision

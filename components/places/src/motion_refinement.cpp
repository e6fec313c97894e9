// SPDX-License-Identifier: Apache-2.0
#include "view_motion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"

namespace panvo::places {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kShared = 2.0;  // keypoints of one thing share its range and the stitching there: two count as one

ViewMotion refine_rotation(const ViewMotion& start, const std::vector<BearingPair>& pairs) {
  Matrix3d sum = Matrix3d::Zero();
  for (const auto& pair : pairs) sum += pair.landmark * pair.panorama.transpose();
  ViewMotion refined = start;
  refined.rotation = vision::nearest_rotation(sum);
  return refined;
}

/// Gauss-Newton over rotation and translation, all points at range one of the place.
ViewMotion refine_equal_range(const ViewMotion& start, const std::vector<BearingPair>& pairs) {
  constexpr double kPriorSigma = 0.3;  // of the translation: half of the range at most, mostly
  constexpr int kSteps = 12;
  ViewMotion motion = start;
  for (int step = 0; step < kSteps; ++step) {
    const double scale = (step < 4 ? 10.0 : 5.0) * vision::kDegree;  // first coarse: ranges differ
    const vision::CauchyLoss loss(1.0);
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity() * 1e-6;
    information.bottomRightCorner<3, 3>() += Matrix3d::Identity() / (kPriorSigma * kPriorSigma);
    Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
    gradient.tail<3>() = motion.translation / (kPriorSigma * kPriorSigma);
    for (const auto& pair : pairs) {
      const Vector3d ray = pair.landmark - motion.translation;
      const double range = ray.norm();
      if (range < 0.1) continue;
      const Vector3d expected = ray / range;
      const Vector3d turned = motion.rotation * pair.panorama;
      const Vector3d residual = (turned - expected) / scale;
      Eigen::Matrix<double, 3, 6> jacobian;
      jacobian.leftCols<3>() = -vision::skew(turned) / scale;
      jacobian.rightCols<3>() = (Matrix3d::Identity() - expected * expected.transpose()) / (range * scale);
      const double weight = loss.weight(residual.squaredNorm());
      information += weight * jacobian.transpose() * jacobian;
      gradient += weight * jacobian.transpose() * residual;
    }
    const Eigen::Matrix<double, 6, 1> change = -information.ldlt().solve(gradient);
    if (!change.allFinite()) return start;
    motion.rotation = vision::so3_exp(change.head<3>()) * motion.rotation;
    motion.translation += change.tail<3>();
    if (motion.translation.norm() > 0.9) motion.translation *= 0.9 / motion.translation.norm();
  }
  return motion;
}

ViewMotion refine_epipolar(const ViewMotion& start, const std::vector<BearingPair>& pairs, double sigma_rad) {
  const auto refined = position_corrector::refine_epipolar_motion(
      {start.rotation, start.translation, Matrix3d::Identity()}, pairs, sigma_rad);
  return {ViewModel::kEpipolar, refined.rotation, refined.direction};
}

}  // namespace

ViewMotion refine_motion(const ViewMotion& start, const std::vector<BearingPair>& pairs, double sigma_rad) {
  switch (start.model) {
    case ViewModel::kRotation:
      return refine_rotation(start, pairs);
    case ViewModel::kEqualRange:
      return refine_equal_range(start, pairs);
    default:
      return refine_epipolar(start, pairs, sigma_rad);
  }
}

MotionUncertainty motion_uncertainty(const ViewMotion& motion, const std::vector<BearingPair>& agreeing,
                                     double sigma_rad) {
  const bool has_range = motion.model == ViewModel::kEqualRange;
  // Information of rotation and translation; for the epipolar model, of the distance from the plane, for unit ranges.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Identity() * 1e-3;
  double squares = 0.0;
  for (const auto& pair : agreeing) {
    const Vector3d turned = motion.rotation * pair.panorama;
    if (motion.model == ViewModel::kEpipolar) {
      const Vector3d normal = pair.landmark.cross(motion.translation);
      const double length = normal.norm();
      if (length < kNearEpipole) continue;
      Eigen::Matrix<double, 6, 1> row;
      row.head<3>() = turned.cross(normal) / length;
      row.tail<3>() = turned.cross(pair.landmark) / length;
      information += row * row.transpose() / (2.0 * sigma_rad * sigma_rad);  // noise of both bearings
      squares += std::pow(turned.dot(normal) / length, 2) / (2.0 * sigma_rad * sigma_rad);
      continue;
    }
    const Vector3d expected = (pair.landmark - motion.translation).normalized();
    Eigen::Matrix<double, 3, 6> jacobian = Eigen::Matrix<double, 3, 6>::Zero();
    jacobian.leftCols<3>() = -vision::skew(turned);
    if (has_range) jacobian.rightCols<3>() = Matrix3d::Identity() - expected * expected.transpose();
    information += jacobian.transpose() * jacobian / (2.0 * sigma_rad * sigma_rad);
    squares += (turned - expected).squaredNorm() / (4.0 * sigma_rad * sigma_rad);
  }
  // Residuals beyond the noise of the bearings, of ranges that differ above all, widen it.
  const double inflation = kShared * std::max(1.0, squares / std::max<std::size_t>(1, agreeing.size()));
  const Eigen::Matrix<double, 6, 6> covariance = inflation * information.inverse();
  const Vector3d direction =
      motion.translation.norm() > 0.0 ? motion.translation.normalized().eval() : Vector3d::Zero().eval();
  const Matrix3d across = Matrix3d::Identity() - direction * direction.transpose();
  const double length = has_range ? std::max(1e-3, motion.translation.norm()) : 1.0;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(across * covariance.bottomRightCorner<3, 3>() * across);
  return {std::sqrt(covariance(1, 1)), std::sqrt(axes.eigenvalues().maxCoeff()) / length};
}

}  // namespace panvo::places

// SPDX-License-Identifier: Apache-2.0
#include "disparity_offset.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "observation_model.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

constexpr int kOffset = 6;  // index after the six motion parameters
constexpr int kIterations = 3;
constexpr double kStep_px = 0.004;    // random walk from frame to frame: temperature, shocks
constexpr double kSameErrors = 10.0;  // frames over which the disparity error of a point is correlated
constexpr double kFarOff2 = 25.0;     // whitened squared error, five standard deviations: moving or mismatched
constexpr double kLossScale = 2.0;    // standard deviations

}  // namespace

Eigen::Isometry3d DisparityOffset::learn(const vision::RectifiedStereo& stereo, std::span<const FramePair> points,
                                         Eigen::Isometry3d current_from_previous) {
  // Cameras at rest show nothing of the offset, which is never less certain than that of an unknown calibration.
  variance_px2_ = std::min(variance_px2_ + kStep_px * kStep_px, kFirstSigma_px * kFirstSigma_px);
  const vision::CauchyLoss loss(kLossScale);
  const double fb = stereo.camera.fx * stereo.baseline_m;
  const Eigen::Isometry3d first_idea = current_from_previous;
  double offset_px = px_, information = 0.0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Matrix7d normal = 1e-6 * Matrix7d::Identity();
    Vector7d gradient = Vector7d::Zero();
    for (const auto& [previous, current] : points) {
      const Eigen::Vector3d offset(0.0, 0.0, offset_px);
      const auto at = predict_with_jacobians(stereo, current_from_previous,
                                             vision::inverse_depth_point(stereo, previous.pixel - offset));
      if (!at) continue;
      const double sigma_px = std::hypot(previous.sigma_px, current.sigma_px);
      const Eigen::Vector3d inverse_sigma(1.0 / sigma_px, 1.0 / sigma_px,
                                          1.0 / std::hypot(previous.sigma_disparity_px, current.sigma_disparity_px));
      const Eigen::Vector3d residual = inverse_sigma.cwiseProduct(at->pixel + offset - current.pixel);
      if (residual.squaredNorm() > kFarOff2) continue;
      Eigen::Matrix<double, 3, 7> jacobian;
      jacobian << at->by_pose, Eigen::Vector3d::UnitZ() - at->by_point.col(2) / fb;
      jacobian = inverse_sigma.asDiagonal() * jacobian;
      const double weight = loss.weight(residual.squaredNorm());
      normal.noalias() += weight * jacobian.transpose() * jacobian;
      gradient.noalias() += weight * jacobian.transpose() * residual;
    }
    const Eigen::LLT<vision::Matrix6d> of_motion(normal.topLeftCorner<6, 6>());
    if (of_motion.info() != Eigen::Success) return first_idea;
    const vision::Vector6d meets = normal.topRightCorner<6, 1>();
    information = std::max(0.0, normal(kOffset, kOffset) - meets.dot(of_motion.solve(meets))) / kSameErrors;
    normal(kOffset, kOffset) += kSameErrors / variance_px2_;
    gradient(kOffset) += kSameErrors / variance_px2_ * (offset_px - px_);
    const Vector7d step = normal.ldlt().solve(-gradient);
    if (!step.allFinite()) return first_idea;
    current_from_previous = vision::se3_exp(step.head<6>()) * current_from_previous;
    offset_px += step[kOffset];
  }
  px_ = std::clamp(offset_px, -kMaxOffset_px, kMaxOffset_px);
  variance_px2_ = 1.0 / (1.0 / variance_px2_ + information);
  return current_from_previous;
}

}  // namespace panvo::binocular_odometry

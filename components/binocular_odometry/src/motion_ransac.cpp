// SPDX-License-Identifier: Apache-2.0
#include "motion_ransac.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "observation_model.hpp"
#include "panvo/vision/absolute_orientation.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"
#include "panvo/vision/stereo_geometry.hpp"

namespace panvo::binocular_odometry {
namespace {

constexpr double kConfidence = 0.999;  // of having drawn at least one triple without outliers
constexpr double kMinDisparity = 1.0;  // px: the depth of farther points is too uncertain for 3D alignment
constexpr int kPolishIterations = 3;

class Consensus {
 public:
  Consensus(const vision::RectifiedStereo& stereo, std::span<const PointPair> pairs, const MotionParameters& parameters)
      : stereo_(stereo),
        pairs_(pairs),
        max_iterations_(parameters.ransac_iterations),
        threshold_px_(parameters.ransac_threshold_px),
        seed_(static_cast<std::uint32_t>(parameters.seed)) {
    for (size_t i = 0; i < pairs.size(); ++i) {
      points_.push_back(vision::inverse_depth_point(stereo, pairs[i].previous));
      all_votes_ += pairs[i].vote;
      if (!pairs[i].has_current_disparity || pairs[i].current.z() < kMinDisparity) continue;
      if (pairs[i].previous.z() < kMinDisparity) continue;
      near_.push_back(
          {*vision::triangulate(stereo, pairs[i].previous), *vision::triangulate(stereo, pairs[i].current)});
      votes_ += pairs[i].vote;
      votes_up_to_.push_back(votes_);
    }
  }

  std::optional<RansacResult> run(std::span<const Eigen::Isometry3d> guesses) {
    for (const auto& guess : guesses) consider(guess);
    std::mt19937 random(seed_);
    for (int i = 0; i < std::min(max_iterations_, iterations_needed()); ++i) {
      if (const auto motion = draw(random)) consider(*motion);
    }
    if (best_.inliers < 3) return std::nullopt;
    return best_;
  }

 private:
  struct NearPoint {
    Eigen::Vector3d in_previous;
    Eigen::Vector3d in_current;
  };

  double error2(size_t i, const Eigen::Isometry3d& current_from_previous) const {
    const auto pixel = predict(stereo_, current_from_previous, points_[i]);
    if (!pixel) return std::numeric_limits<double>::infinity();
    const Eigen::Vector3d error = *pixel - pairs_[i].current;
    return std::max(error.head<2>().squaredNorm(), pairs_[i].has_current_disparity ? error.z() * error.z() : 0.0);
  }

  // Truncated squared error, which also ranks motions with the same inliers [Torr and Zisserman 2000].
  double score(const Eigen::Isometry3d& motion) const {
    const double threshold2 = threshold_px_ * threshold_px_;
    double sum = 0.0;
    for (size_t i = 0; i < points_.size(); ++i) sum += pairs_[i].vote * std::min(error2(i, motion), threshold2);
    return sum;
  }

  void consider(const Eigen::Isometry3d& motion) {
    double now = score(motion);
    if (now >= best_score_) return;
    Eigen::Isometry3d improved = motion;
    const Eigen::Isometry3d polished = polish(motion);
    if (const double then = score(polished); then < now) {
      improved = polished;
      now = then;
    }
    best_score_ = now;
    best_.current_from_previous = improved;
    best_.is_inlier.assign(points_.size(), false);
    best_.inliers = 0;
    inlier_votes_ = 0.0;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (error2(i, improved) > threshold_px_ * threshold_px_) continue;
      best_.is_inlier[i] = true;
      ++best_.inliers;
      inlier_votes_ += pairs_[i].vote;
    }
  }

  // Gauss-Newton on the reprojection errors within 3 thresholds, with decreasing weight for larger errors.
  Eigen::Isometry3d polish(Eigen::Isometry3d motion) const {
    const vision::CauchyLoss loss(0.5 * threshold_px_);
    const double reach2 = 9.0 * threshold_px_ * threshold_px_;
    for (int iteration = 0; iteration < kPolishIterations; ++iteration) {
      vision::Matrix6d normal = 1e-6 * vision::Matrix6d::Identity();
      vision::Vector6d gradient = vision::Vector6d::Zero();
      for (size_t i = 0; i < points_.size(); ++i) {
        const auto at = predict_with_jacobians(stereo_, motion, points_[i]);
        if (!at) continue;
        Eigen::Vector3d residual = at->pixel - pairs_[i].current;
        if (!pairs_[i].has_current_disparity) residual.z() = 0.0;
        if (residual.squaredNorm() > reach2) continue;
        const double weight = pairs_[i].vote * loss.weight(residual.squaredNorm());
        const int rows = pairs_[i].has_current_disparity ? 3 : 2;
        const auto jacobian = at->by_pose.topRows(rows);
        normal.noalias() += weight * jacobian.transpose() * jacobian;
        gradient.noalias() += weight * jacobian.transpose() * residual.head(rows);
      }
      const Eigen::LLT<vision::Matrix6d> factor(normal);
      if (factor.info() != Eigen::Success) break;
      const vision::Vector6d step = factor.solve(-gradient);
      if (!step.allFinite()) break;
      motion = vision::se3_exp(step) * motion;
    }
    return motion;
  }

  std::optional<Eigen::Isometry3d> draw(std::mt19937& random) const {
    if (near_.size() < 3) return std::nullopt;
    std::array<size_t, 3> chosen{};
    for (size_t k = 0; k < 3; ++k) {
      // Own sampling, because standard distributions differ between libraries. The probability is proportional to the
      // vote.
      const double at = votes_ * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
      const auto found = std::lower_bound(votes_up_to_.begin(), votes_up_to_.end() - 1, at);
      chosen[k] = static_cast<size_t>(found - votes_up_to_.begin());
    }
    if (chosen[0] == chosen[1] || chosen[0] == chosen[2] || chosen[1] == chosen[2]) return std::nullopt;
    std::array<Eigen::Vector3d, 3> in_previous, in_current;
    for (size_t k = 0; k < 3; ++k) {
      in_previous[k] = near_[chosen[k]].in_previous;
      in_current[k] = near_[chosen[k]].in_current;
    }
    return vision::absolute_orientation(in_current, in_previous);
  }

  int iterations_needed() const {
    if (points_.empty()) return 0;
    const double ratio = inlier_votes_ / all_votes_;
    const double clean = ratio * ratio * ratio;
    if (clean <= 1e-9) return max_iterations_;
    if (clean >= 1.0 - 1e-9) return 1;
    return static_cast<int>(std::ceil(std::log(1.0 - kConfidence) / std::log1p(-clean)));
  }

  const vision::RectifiedStereo& stereo_;
  std::span<const PointPair> pairs_;
  const int max_iterations_;
  const double threshold_px_;
  const std::uint32_t seed_;
  std::vector<Eigen::Vector3d> points_;  // inverse depth, in the previous frame
  std::vector<NearPoint> near_;
  std::vector<double> votes_up_to_;  // cumulative, of near_
  double votes_ = 0.0, all_votes_ = 0.0;
  double best_score_ = std::numeric_limits<double>::infinity();
  RansacResult best_;
  double inlier_votes_ = 0.0;
};

}  // namespace

std::optional<RansacResult> estimate_motion(const vision::RectifiedStereo& stereo, std::span<const PointPair> pairs,
                                            std::span<const Eigen::Isometry3d> guesses,
                                            const MotionParameters& parameters) {
  return Consensus(stereo, pairs, parameters).run(guesses);
}

}  // namespace panvo::binocular_odometry

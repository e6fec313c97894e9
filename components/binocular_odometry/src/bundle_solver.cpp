// SPDX-License-Identifier: Apache-2.0
#include "bundle_solver.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "observation_model.hpp"
#include "panvo/vision/robust_loss.hpp"

namespace panvo::binocular_odometry {
namespace {

using vision::Matrix6d;
using vision::Vector6d;
using Matrix36d = Eigen::Matrix<double, 3, 6>;
using Matrix63d = Eigen::Matrix<double, 6, 3>;

constexpr double kFirstDamping = 1e-5;
constexpr double kLargestDamping = 1e3;
constexpr double kPointPrior = 1e-6;       // keeps a point seen along one ray solvable; far too weak to move another

struct Linearised {
  bool is_in_front = false;
  Eigen::Vector3d residual;
  Eigen::Matrix3d by_point;
  Matrix36d by_pose;
};

Linearised linearise(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_world,
                     const BundlePoint& point, const BundleObservation& observation) {
  Linearised result;
  const auto prediction = predict_with_jacobians(stereo, left_from_world * point.world_from_anchor, point.inverse_depth);
  if (!prediction) return result;
  const auto whitening = observation.inverse_sigma.asDiagonal();
  result.is_in_front = true;
  result.residual = whitening * (prediction->pixel - observation.pixel);
  result.by_point = whitening * prediction->by_point;
  result.by_pose = whitening * prediction->by_pose;
  return result;
}

class Solver {
 public:
  Solver(const vision::RectifiedStereo& stereo, BundleProblem& problem, const BundleOptions& options)
      : stereo_(stereo),
        problem_(problem),
        options_(options),
        loss_(options.loss_scale),
        free_frames_(static_cast<int>(problem.left_from_world.size()) - problem.fixed_frames) {
    first_observation_.assign(problem.points.size() + 1, 0);
    for (const auto& observation : problem.observations) ++first_observation_[static_cast<size_t>(observation.point) + 1];
    for (size_t i = 0; i < problem.points.size(); ++i) first_observation_[i + 1] += first_observation_[i];
  }

  BundleSummary run() {
    BundleSummary summary;
    summary.initial_cost = summary.final_cost = cost(problem_.left_from_world, problem_.points);
    double damping = kFirstDamping;
    bool settled = false;
    while (summary.iterations < options_.max_iterations && !settled && damping < kLargestDamping) {
      ++summary.iterations;
      build_normal_equations();
      for (settled = true; damping < kLargestDamping; damping *= 10.0) {
        if (!try_step(damping)) continue;
        const double improved = cost(moved_frames_, moved_points_);
        if (!(improved <= summary.final_cost)) continue;
        settled = summary.final_cost - improved < options_.smallest_improvement * summary.final_cost;
        problem_.left_from_world.swap(moved_frames_);
        problem_.points.swap(moved_points_);
        summary.final_cost = improved;
        damping = std::max(kFirstDamping, 0.1 * damping);
        break;
      }
    }
    build_normal_equations();
    summarise(summary);
    return summary;
  }

 private:
  struct PointBlock {
    Eigen::Matrix3d normal;
    Eigen::Vector3d gradient;
  };

  double cost(const std::vector<Eigen::Isometry3d>& frames, const std::vector<BundlePoint>& points) const {
    double sum = 0.0;
    for (const auto& observation : problem_.observations) {
      const double square = whitened_residual(stereo_, frames[static_cast<size_t>(observation.frame)],
                                              points[static_cast<size_t>(observation.point)], observation)
                                .squaredNorm();
      if (!std::isfinite(square)) return std::numeric_limits<double>::infinity();
      sum += loss_.cost(square);
    }
    return 0.5 * sum;
  }

  int free_index(int frame) const { return frame - problem_.fixed_frames; }

  void build_normal_equations() {
    frame_normal_.assign(static_cast<size_t>(free_frames_), Matrix6d::Zero());
    frame_gradient_ = Eigen::VectorXd::Zero(6 * free_frames_);
    point_blocks_.assign(problem_.points.size(), {kPointPrior * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()});
    cross_.resize(problem_.observations.size());
    weighted_squares_ = 0.0;
    weighted_count_ = 0.0;
    for (size_t i = 0; i < problem_.observations.size(); ++i) {
      const auto& observation = problem_.observations[i];
      const Linearised at = linearise(stereo_, problem_.left_from_world[static_cast<size_t>(observation.frame)],
                                      problem_.points[static_cast<size_t>(observation.point)], observation);
      cross_[i].setZero();
      if (!at.is_in_front) continue;
      const double square = at.residual.squaredNorm(), weight = loss_.weight(square);
      weighted_squares_ += weight * square;
      weighted_count_ += weight * (observation.inverse_sigma.z() > 0.0 ? 3.0 : 2.0);
      PointBlock& point = point_blocks_[static_cast<size_t>(observation.point)];
      const Eigen::Matrix3d weighted_by_point = weight * at.by_point;
      point.normal.noalias() += at.by_point.transpose() * weighted_by_point;
      point.gradient.noalias() += weighted_by_point.transpose() * at.residual;
      const int frame = free_index(observation.frame);
      if (frame < 0) continue;
      frame_normal_[static_cast<size_t>(frame)].noalias() += weight * at.by_pose.transpose() * at.by_pose;
      frame_gradient_.segment<6>(6 * frame).noalias() += weight * at.by_pose.transpose() * at.residual;
      cross_[i].noalias() = at.by_pose.transpose() * weighted_by_point;
    }
  }

  // Schur complement of the points: what the poses are left with.
  void eliminate_points(double damping) {
    reduced_ = Eigen::MatrixXd::Zero(6 * free_frames_, 6 * free_frames_);
    reduced_gradient_ = frame_gradient_;
    for (int frame = 0; frame < free_frames_; ++frame) {
      Matrix6d block = frame_normal_[static_cast<size_t>(frame)];
      block.diagonal() *= 1.0 + damping;
      reduced_.block<6, 6>(6 * frame, 6 * frame) = block;
    }
    inverse_point_normal_.resize(problem_.points.size());
    for (size_t p = 0; p < problem_.points.size(); ++p) {
      Eigen::Matrix3d normal = point_blocks_[p].normal;
      normal.diagonal() *= 1.0 + damping;
      inverse_point_normal_[p] = normal.inverse();
      for (size_t i = first_observation_[p]; i < first_observation_[p + 1]; ++i) {
        const int row = free_index(problem_.observations[i].frame);
        if (row < 0) continue;
        const Matrix63d by_inverse = cross_[i] * inverse_point_normal_[p];
        reduced_gradient_.segment<6>(6 * row).noalias() -= by_inverse * point_blocks_[p].gradient;
        for (size_t j = first_observation_[p]; j < first_observation_[p + 1]; ++j) {
          const int column = free_index(problem_.observations[j].frame);
          if (column < 0 || column > row) continue;  // the lower triangle will do
          reduced_.block<6, 6>(6 * row, 6 * column).noalias() -= by_inverse * cross_[j].transpose();
        }
      }
    }
  }

  bool try_step(double damping) {
    eliminate_points(damping);
    const Eigen::LLT<Eigen::MatrixXd> factor(reduced_);
    if (factor.info() != Eigen::Success) return false;
    const Eigen::VectorXd step = factor.solve(-reduced_gradient_);
    if (!step.allFinite()) return false;
    moved_frames_ = problem_.left_from_world;
    for (int frame = 0; frame < free_frames_; ++frame) {
      Eigen::Isometry3d& pose = moved_frames_[static_cast<size_t>(frame + problem_.fixed_frames)];
      pose = vision::se3_exp(step.segment<6>(6 * frame)) * pose;
      pose.linear() = vision::nearest_rotation(pose.linear());
    }
    moved_points_ = problem_.points;
    for (size_t p = 0; p < problem_.points.size(); ++p) {
      Eigen::Vector3d gradient = point_blocks_[p].gradient;
      for (size_t i = first_observation_[p]; i < first_observation_[p + 1]; ++i) {
        const int frame = free_index(problem_.observations[i].frame);
        if (frame >= 0) gradient.noalias() += cross_[i].transpose() * step.segment<6>(6 * frame);
      }
      moved_points_[p].inverse_depth.noalias() -= inverse_point_normal_[p] * gradient;
    }
    return true;
  }

  void summarise(BundleSummary& summary) {
    const double unknowns = 6.0 * free_frames_ + 3.0 * static_cast<double>(problem_.points.size());
    // A redescending loss takes weight from the tails; dividing by the same weights keeps the mean square comparable.
    summary.variance = weighted_squares_ / std::max(1.0, weighted_count_ - unknowns);
    eliminate_points(0.0);
    const Eigen::MatrixXd symmetric = reduced_.selfadjointView<Eigen::Lower>();
    const Eigen::LLT<Eigen::MatrixXd> factor(symmetric);
    if (factor.info() == Eigen::Success) {
      summary.covariance = factor.solve(Eigen::MatrixXd::Identity(symmetric.rows(), symmetric.cols()));
    }
  }

  const vision::RectifiedStereo& stereo_;
  BundleProblem& problem_;
  const BundleOptions& options_;
  vision::CauchyLoss loss_;
  int free_frames_;
  std::vector<size_t> first_observation_;  // of each point, and one past the last
  std::vector<Matrix6d> frame_normal_;
  Eigen::VectorXd frame_gradient_;
  std::vector<PointBlock> point_blocks_;
  std::vector<Matrix63d> cross_;  // pose by point, one an observation
  std::vector<Eigen::Matrix3d> inverse_point_normal_;
  Eigen::MatrixXd reduced_;
  Eigen::VectorXd reduced_gradient_;
  std::vector<Eigen::Isometry3d> moved_frames_;
  std::vector<BundlePoint> moved_points_;
  double weighted_squares_ = 0.0;
  double weighted_count_ = 0.0;
};

}  // namespace

Eigen::Vector3d whitened_residual(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_world,
                                  const BundlePoint& point, const BundleObservation& observation) {
  const auto pixel = predict(stereo, left_from_world * point.world_from_anchor, point.inverse_depth);
  if (!pixel) return Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  return (*pixel - observation.pixel).cwiseProduct(observation.inverse_sigma);
}

BundleSummary solve(const vision::RectifiedStereo& stereo, BundleProblem& problem, const BundleOptions& options) {
  return Solver(stereo, problem, options).run();
}

}  // namespace panvo::binocular_odometry

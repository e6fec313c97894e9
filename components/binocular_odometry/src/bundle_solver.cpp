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
using Matrix63d = Eigen::Matrix<double, 6, 3>;

constexpr double kFirstDamping = 1e-5;
constexpr double kMaxDamping = 1e3;
constexpr double kPointPrior = 1e-6;  // regularises points seen along one ray; negligible for others

/// Unknowns are the free poses (six each), the disparity offset (one) and the points (three each). Points are coupled
/// only through poses and offset, so they are eliminated one by one; the reduced system is small and dense.
class Solver {
 public:
  Solver(const vision::RectifiedStereo& stereo, BundleProblem& problem, const BundleOptions& options)
      : stereo_(stereo),
        problem_(problem),
        options_(options),
        loss_(options.loss_scale),
        free_frames_(static_cast<int>(problem.left_from_world.size()) - problem.fixed_frames) {
    first_observation_.assign(problem.points.size() + 1, 0);
    for (const auto& observation : problem.observations)
      ++first_observation_[static_cast<size_t>(observation.point) + 1];
    for (size_t i = 0; i < problem.points.size(); ++i) first_observation_[i + 1] += first_observation_[i];
  }

  BundleSummary run() {
    BundleSummary summary;
    summary.initial_cost = summary.final_cost = cost(problem_);
    double damping = kFirstDamping;
    for (bool settled = false; summary.iterations < options_.max_iterations && !settled;) {
      ++summary.iterations;
      build_normal_equations();
      for (settled = true; damping < kMaxDamping; damping *= 10.0) {
        if (!try_step(damping)) continue;
        const double improved = cost(moved_);
        if (!(improved <= summary.final_cost)) continue;
        settled = summary.final_cost - improved < options_.min_improvement * summary.final_cost;
        std::swap(problem_.left_from_world, moved_.left_from_world);
        std::swap(problem_.points, moved_.points);
        problem_.disparity_offset_px = moved_.disparity_offset_px;
        summary.final_cost = improved;
        damping = std::max(kFirstDamping, 0.1 * damping);
        break;
      }
    }
    summarise(summary);
    return summary;
  }

 private:
  struct PointBlock {
    Eigen::Matrix3d normal;
    Eigen::Vector3d gradient;
    Eigen::Vector3d by_offset;
  };

  // Variables changed by a step.
  struct State {
    std::vector<Eigen::Isometry3d> left_from_world;
    std::vector<BundlePoint> points;
    double disparity_offset_px = 0.0;
  };

  template <class StateOrProblem>
  double cost(const StateOrProblem& state) const {
    double sum = problem_.offset_information * std::pow(state.disparity_offset_px - problem_.expected_offset_px, 2);
    for (const auto& observation : problem_.observations) {
      const double square = whitened_residual(stereo_, state.left_from_world[static_cast<size_t>(observation.frame)],
                                              state.points[static_cast<size_t>(observation.point)], observation,
                                              state.disparity_offset_px)
                                .squaredNorm();
      if (!std::isfinite(square)) return std::numeric_limits<double>::infinity();
      sum += loss_.cost(square);
    }
    return 0.5 * sum;
  }

  int free_index(int frame) const { return frame - problem_.fixed_frames; }
  int offset_index() const { return 6 * free_frames_; }

  void build_normal_equations() {
    normal_ = Eigen::MatrixXd::Zero(offset_index() + 1, offset_index() + 1);
    gradient_ = Eigen::VectorXd::Zero(offset_index() + 1);
    point_blocks_.assign(problem_.points.size(),
                         {kPointPrior * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
    cross_.resize(problem_.observations.size());
    normal_(offset_index(), offset_index()) = problem_.offset_information;
    gradient_(offset_index()) =
        problem_.offset_information * (problem_.disparity_offset_px - problem_.expected_offset_px);
    weighted_squares_ = weighted_count_ = 0.0;
    for (size_t i = 0; i < problem_.observations.size(); ++i) add(i);
  }

  void add(size_t i) {
    const BundleObservation& observation = problem_.observations[i];
    const BundlePoint& point = problem_.points[static_cast<size_t>(observation.point)];
    cross_[i].setZero();
    const auto prediction = predict_with_jacobians(
        stereo_, problem_.left_from_world[static_cast<size_t>(observation.frame)] * point.world_from_anchor,
        point.inverse_depth);
    if (!prediction) return;
    const Eigen::Vector3d& whitening = observation.inverse_sigma;
    Eigen::Vector3d residual = prediction->pixel - observation.pixel;
    residual.z() += problem_.disparity_offset_px;
    residual.array() *= whitening.array();
    const double square = residual.squaredNorm(), weight = loss_.weight(square);
    weighted_squares_ += weight * square;
    weighted_count_ += weight * (whitening.z() > 0.0 ? 3.0 : 2.0);

    // All quantities below are in units of the weighted standard deviation.
    const Eigen::Vector3d scale = std::sqrt(weight) * whitening;
    residual *= std::sqrt(weight);
    const Eigen::Matrix3d by_point = scale.asDiagonal() * prediction->by_point;
    PointBlock& block = point_blocks_[static_cast<size_t>(observation.point)];
    block.normal.noalias() += by_point.transpose() * by_point;
    block.gradient.noalias() += by_point.transpose() * residual;
    block.by_offset.noalias() += scale.z() * by_point.row(2).transpose();
    normal_(offset_index(), offset_index()) += scale.z() * scale.z();
    gradient_(offset_index()) += scale.z() * residual.z();

    const int row = 6 * free_index(observation.frame);
    if (row < 0) return;
    const Eigen::Matrix<double, 3, 6> by_pose = scale.asDiagonal() * prediction->by_pose;
    normal_.block<6, 6>(row, row).noalias() += by_pose.transpose() * by_pose;
    normal_.block<1, 6>(offset_index(), row).noalias() += scale.z() * by_pose.row(2);
    gradient_.segment<6>(row).noalias() += by_pose.transpose() * residual;
    cross_[i].noalias() = by_pose.transpose() * by_point;
  }

  // Schur complement of the points, lower triangle.
  void eliminate_points(double damping) {
    damping_of_reduced_ = damping;
    reduced_ = normal_;
    reduced_.diagonal() *= 1.0 + damping;
    reduced_gradient_ = gradient_;
    inverse_point_normal_.resize(problem_.points.size());
    const int offset = offset_index();
    for (size_t p = 0; p < problem_.points.size(); ++p) {
      const PointBlock& block = point_blocks_[p];
      Eigen::Matrix3d damped = block.normal;
      damped.diagonal() *= 1.0 + damping;
      inverse_point_normal_[p] = damped.inverse();
      const Eigen::Vector3d offset_by_inverse = inverse_point_normal_[p] * block.by_offset;
      reduced_(offset, offset) -= offset_by_inverse.dot(block.by_offset);
      reduced_gradient_(offset) -= offset_by_inverse.dot(block.gradient);
      for (size_t i = first_observation_[p]; i < first_observation_[p + 1]; ++i) {
        const int row = 6 * free_index(problem_.observations[i].frame);
        if (row < 0) continue;
        const Matrix63d by_inverse = cross_[i] * inverse_point_normal_[p];
        reduced_gradient_.segment<6>(row).noalias() -= by_inverse * block.gradient;
        reduced_.block<1, 6>(offset, row).noalias() -= (cross_[i] * offset_by_inverse).transpose();
        for (size_t j = first_observation_[p]; j <= i; ++j) {  // frames ascend within a point
          const int column = 6 * free_index(problem_.observations[j].frame);
          if (column < 0) continue;
          reduced_.block<6, 6>(row, column).noalias() -= by_inverse * cross_[j].transpose();
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
    moved_.left_from_world = problem_.left_from_world;
    for (int frame = 0; frame < free_frames_; ++frame) {
      Eigen::Isometry3d& pose = moved_.left_from_world[static_cast<size_t>(frame + problem_.fixed_frames)];
      pose = vision::se3_exp(step.segment<6>(6 * frame)) * pose;
      pose.linear() = vision::nearest_rotation(pose.linear());
    }
    const double offset_step = step(offset_index());
    moved_.disparity_offset_px = problem_.disparity_offset_px + offset_step;
    moved_.points = problem_.points;
    for (size_t p = 0; p < problem_.points.size(); ++p) {
      Eigen::Vector3d gradient = point_blocks_[p].gradient + offset_step * point_blocks_[p].by_offset;
      for (size_t i = first_observation_[p]; i < first_observation_[p + 1]; ++i) {
        const int row = 6 * free_index(problem_.observations[i].frame);
        if (row >= 0) gradient.noalias() += cross_[i].transpose() * step.segment<6>(row);
      }
      moved_.points[p].inverse_depth.noalias() -= inverse_point_normal_[p] * gradient;
    }
    return true;
  }

  // Uses the normal equations of the last step, which was small. Damping that it may have needed adds information that
  // nobody measured.
  void summarise(BundleSummary& summary) {
    const double unknowns = 6.0 * free_frames_ + 3.0 * static_cast<double>(problem_.points.size());
    // The redescending loss reduces the weight of the tails; dividing by the same weights keeps the mean square
    // comparable.
    summary.variance = weighted_squares_ / std::max(1.0, weighted_count_ - unknowns);
    if (damping_of_reduced_ > kFirstDamping) eliminate_points(kFirstDamping);
    const Eigen::MatrixXd symmetric = reduced_.selfadjointView<Eigen::Lower>();
    const Eigen::LLT<Eigen::MatrixXd> factor(symmetric);
    if (factor.info() != Eigen::Success) return;
    const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(symmetric.rows(), symmetric.cols()));
    summary.covariance = inverse.topLeftCorner(offset_index(), offset_index());
  }

  const vision::RectifiedStereo& stereo_;
  BundleProblem& problem_;
  const BundleOptions& options_;
  vision::CauchyLoss loss_;
  int free_frames_;
  std::vector<size_t> first_observation_;  // per point, and the end
  Eigen::MatrixXd normal_;                 // poses and offset; the offset is the last row
  Eigen::VectorXd gradient_;
  std::vector<PointBlock> point_blocks_;
  std::vector<Matrix63d> cross_;  // pose by point, one per observation
  std::vector<Eigen::Matrix3d> inverse_point_normal_;
  Eigen::MatrixXd reduced_;
  double damping_of_reduced_ = 0.0;
  Eigen::VectorXd reduced_gradient_;
  State moved_;
  double weighted_squares_ = 0.0;
  double weighted_count_ = 0.0;
};

}  // namespace

Eigen::Vector3d whitened_residual(const vision::RectifiedStereo& stereo, const Eigen::Isometry3d& left_from_world,
                                  const BundlePoint& point, const BundleObservation& observation,
                                  double disparity_offset_px) {
  const auto pixel = predict(stereo, left_from_world * point.world_from_anchor, point.inverse_depth);
  if (!pixel) return Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d residual = *pixel - observation.pixel;
  residual.z() += disparity_offset_px;
  return residual.cwiseProduct(observation.inverse_sigma);
}

BundleSummary solve(const vision::RectifiedStereo& stereo, BundleProblem& problem, const BundleOptions& options) {
  return Solver(stereo, problem, options).run();
}

}  // namespace panvo::binocular_odometry

// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/pose_graph.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace panvo::localizer {
namespace {

constexpr double kLossScale = 3.0;  // standard deviations
constexpr int kMaxSteps = 50;

/// Translation, then the quaternion in Eigen's order: x y z w.
using Block = std::array<double, 7>;
constexpr double kRounding = 1e-12;

using Manifold = ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>;

Block to_block(const Eigen::Isometry3d& pose) {
  Block block{};
  Eigen::Map<Eigen::Vector3d>(block.data()) = pose.translation();
  Eigen::Map<Eigen::Quaterniond>(block.data() + 3) = Eigen::Quaterniond(pose.linear()).normalized();
  return block;
}

Eigen::Isometry3d to_pose(const Block& block) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(block.data());
  pose.linear() = Eigen::Map<const Eigen::Quaterniond>(block.data() + 3).normalized().toRotationMatrix();
  return pose;
}

template <class Matrix>
Matrix whitening(const Matrix& covariance) {
  Eigen::LLT<Matrix> factor(covariance);
  if (factor.info() != Eigen::Success && covariance.allFinite()) {
    // Semidefinite, or definite but lost in rounding: eigenvalues are raised to the rounding level.
    const Eigen::SelfAdjointEigenSolver<Matrix> parts(covariance);
    const double least = kRounding * parts.eigenvalues().cwiseAbs().maxCoeff();
    factor.compute(parts.eigenvectors() * parts.eigenvalues().cwiseMax(least).asDiagonal() *
                   parts.eigenvectors().transpose());
  }
  if (factor.info() != Eigen::Success) throw std::invalid_argument("pose graph: a covariance is not positive definite");
  return factor.matrixL().solve(Matrix::Identity());
}

/// Whitened vision::pose_error between the estimated and the measured a_from_b.
template <class T>
void whitened_error(const Eigen::Matrix<T, 3, 1>& translation, const Eigen::Quaternion<T>& rotation,
                    const Eigen::Isometry3d& measured, const vision::Matrix6d& whiten, T* residual) {
  Eigen::Matrix<T, 6, 1> error;
  error.template head<3>() = translation - measured.translation().cast<T>();
  const Eigen::Quaternion<T> turn = rotation * Eigen::Quaterniond(measured.linear()).conjugate().cast<T>();
  const T sign = turn.w() < T(0) ? T(-2) : T(2);
  error.template tail<3>() = sign * turn.vec();  // small-angle approximation; monotonic up to half a turn
  Eigen::Map<Eigen::Matrix<T, 6, 1>> result(residual);
  result = whiten.cast<T>() * error;
}

struct EdgeCost {
  Eigen::Isometry3d measured;
  vision::Matrix6d whiten;

  template <class T>
  bool operator()(const T* from, const T* to, T* residual) const {
    const T exact(1.0);
    return (*this)(from, to, &exact, residual);
  }

  template <class T>
  bool operator()(const T* from, const T* to, const T* scale, T* residual) const {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> from_translation(from), to_translation(to);
    const Eigen::Map<const Eigen::Quaternion<T>> from_rotation(from + 3), to_rotation(to + 3);
    const Eigen::Quaternion<T> back = from_rotation.conjugate();
    const Eigen::Matrix<T, 3, 1> translation = back * (to_translation - from_translation) * *scale;
    whitened_error<T>(translation, back * to_rotation, measured, whiten, residual);
    return true;
  }
};

struct FixCost {
  Eigen::Vector3d point_in_pose, velocity_in_pose, point_in_frame;
  Eigen::Matrix3d whiten;

  template <class T>
  bool operator()(const T* frame, const T* pose, const T* delay, T* residual) const {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> frame_translation(frame), translation(pose);
    const Eigen::Map<const Eigen::Quaternion<T>> frame_rotation(frame + 3), rotation(pose + 3);
    const Eigen::Matrix<T, 3, 1> in_pose = point_in_pose.cast<T>() - *delay * velocity_in_pose.cast<T>();
    const Eigen::Matrix<T, 3, 1> point = rotation * in_pose + translation;
    const Eigen::Matrix<T, 3, 1> error =
        frame_rotation.conjugate() * (point - frame_translation) - point_in_frame.cast<T>();
    Eigen::Map<Eigen::Matrix<T, 3, 1>> result(residual);
    result = whiten.cast<T>() * error;
    return true;
  }
};

struct NumberPrior {
  double expected, sigma;

  template <class T>
  bool operator()(const T* number, T* residual) const {
    *residual = (*number - T(expected)) / T(sigma);
    return true;
  }
};

struct PriorCost {
  Eigen::Isometry3d known;
  vision::Matrix6d whiten;

  template <class T>
  bool operator()(const T* pose, T* residual) const {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> translation(pose);
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(pose + 3);
    whitened_error<T>(translation, rotation, known, whiten, residual);
    return true;
  }
};

/// The graph as a Ceres problem.
struct Problem {
  explicit Problem(const PoseGraph& graph) {
    const auto check = [&](std::size_t pose) {
      if (pose >= graph.poses.size()) {
        throw std::invalid_argument(fmt::format("pose graph: there is no pose {} of {}", pose, graph.poses.size()));
      }
    };
    blocks.reserve(graph.poses.size());
    for (const auto& pose : graph.poses) {
      blocks.push_back(to_block(pose));
      problem.AddParameterBlock(blocks.back().data(), 7, new Manifold);
    }
    add_number(graph.scale, graph.expected_scale, graph.scale_sigma, scale);
    add_number(graph.delay, 0.0, graph.delay_sigma, delay);
    for (const auto& edge : graph.edges) {
      check(edge.from);
      check(edge.to);
      add(edge, graph.scale_sigma > 0.0);
    }
    for (const auto& fix : graph.fixes) {
      check(fix.frame);
      check(fix.pose);
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<FixCost, 3, 7, 7, 1>(
              new FixCost{fix.point_in_pose, fix.velocity_in_pose, fix.point_in_frame, whitening(fix.covariance)}),
          new ceres::CauchyLoss(kLossScale), blocks[fix.frame].data(), blocks[fix.pose].data(), &delay);
    }
    if (!graph.fixes.empty() && graph.delay_sigma == 0.0) problem.SetParameterBlockConstant(&delay);
    for (const auto& prior : graph.priors) {
      check(prior.pose);
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PriorCost, 6, 7>(
                                   new PriorCost{prior.map_from_pose, whitening(prior.covariance)}),
                               nullptr, blocks[prior.pose].data());
    }
  }

  void add_number(double initial, double expected, double sigma, double& number) {
    number = initial;
    if (!(sigma > 0.0)) return;
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<NumberPrior, 1, 1>(new NumberPrior{expected, sigma}),
                             nullptr, &number);
  }

  void add(const PoseGraph::Edge& edge, bool has_scale) {
    auto* const cost = new EdgeCost{edge.from_from_to, whitening(edge.covariance)};
    auto* const loss = edge.is_robust ? new ceres::CauchyLoss(kLossScale) : nullptr;
    if (edge.is_scaled && has_scale) {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeCost, 6, 7, 7, 1>(cost), loss,
                               blocks[edge.from].data(), blocks[edge.to].data(), &scale);
    } else {
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<EdgeCost, 6, 7, 7>(cost), loss, blocks[edge.from].data(),
                               blocks[edge.to].data());
    }
  }

  std::vector<Block> blocks;  // never grows, as Ceres stores the addresses
  double scale = 1.0, delay = 0.0;
  ceres::Problem problem;
};

/// Covariance of two pose blocks; Ceres' step of a quaternion is half the rotation vector about the map's axes.
std::optional<vision::Matrix6d> tangent_covariance(const ceres::Covariance& covariance, const Block& a,
                                                   const Block& b) {
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> tangent;
  if (!covariance.GetCovarianceBlockInTangentSpace(a.data(), b.data(), tangent.data())) return std::nullopt;
  tangent.bottomRows<3>() *= 2.0;
  tangent.rightCols<3>() *= 2.0;
  if (!tangent.allFinite()) return std::nullopt;
  return tangent;
}

}  // namespace

bool PoseGraph::optimise() {
  Problem problem(*this);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kMaxSteps;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem.problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  std::vector<Eigen::Isometry3d> moved;
  for (const auto& block : problem.blocks) {
    moved.push_back(to_pose(block));
    if (!moved.back().matrix().allFinite()) return false;
  }
  if (!std::isfinite(problem.scale) || !std::isfinite(problem.delay)) return false;
  poses = std::move(moved);
  scale = problem.scale;
  delay = problem.delay;
  return true;
}

std::optional<PoseGraph::Covariances> PoseGraph::covariances(
    const std::vector<std::size_t>& of, std::optional<std::pair<std::size_t, std::size_t>> pair) const {
  Problem problem(*this);
  std::vector<const Block*> asked;
  for (const std::size_t pose : of) asked.push_back(&problem.blocks.at(pose));
  if (of.empty()) {
    for (const auto& block : problem.blocks) asked.push_back(&block);
  }
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  std::vector<std::pair<const double*, const double*>> wanted;
  for (const auto* block : asked) wanted.emplace_back(block->data(), block->data());
  if (pair) wanted.emplace_back(problem.blocks[pair->first].data(), problem.blocks[pair->second].data());
  if (scale_sigma > 0.0) wanted.emplace_back(&problem.scale, &problem.scale);
  if (delay_sigma > 0.0) wanted.emplace_back(&problem.delay, &problem.delay);
  if (!covariance.Compute(wanted, &problem.problem)) return std::nullopt;
  Covariances result;
  for (const auto* block : asked) {
    const auto tangent = tangent_covariance(covariance, *block, *block);
    if (!tangent) return std::nullopt;
    result.poses.emplace_back(0.5 * (*tangent + tangent->transpose()));
  }
  if (pair) {
    const auto cross = tangent_covariance(covariance, problem.blocks[pair->first], problem.blocks[pair->second]);
    if (!cross) return std::nullopt;
    result.cross = *cross;
  }
  if (scale_sigma > 0.0 && !covariance.GetCovarianceBlock(&problem.scale, &problem.scale, &result.scale_variance))
    return std::nullopt;
  if (delay_sigma > 0.0 && !covariance.GetCovarianceBlock(&problem.delay, &problem.delay, &result.delay_variance))
    return std::nullopt;
  return result;
}

}  // namespace panvo::localizer

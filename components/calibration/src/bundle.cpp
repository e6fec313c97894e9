// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/bundle.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <array>
#include <cmath>

#include "lens_projection.hpp"
#include "panvo/calibration/lens_parameters.hpp"

namespace panvo::calibration {
namespace {

using vision::LensModel;
using Pose = std::array<double, 6>;  // rotation vector, translation

constexpr int kMaxSteps = 200;
constexpr double kMaxTrust =
    1e12;  // limits the trust region: slight damping of weakly determined parameters keeps the equations solvable

Pose to_pose(const Eigen::Isometry3d& a_from_b) {
  Pose pose;
  Eigen::Map<Eigen::Vector3d>(pose.data()) = vision::so3_log(a_from_b.linear());
  Eigen::Map<Eigen::Vector3d>(pose.data() + 3) = a_from_b.translation();
  return pose;
}

Eigen::Isometry3d to_isometry(const Pose& pose) {
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = vision::so3_exp(Eigen::Map<const Eigen::Vector3d>(pose.data()));
  a_from_b.translation() = Eigen::Map<const Eigen::Vector3d>(pose.data() + 3);
  return a_from_b;
}

/// Reprojection error of a board corner.
template <vision::LensFormula Formula>
struct Reprojection {
  Eigen::Vector3d point_in_board;
  Eigen::Vector2d pixel;

  template <typename T>
  bool operator()(const T* lens, const T* camera_from_reference, const T* reference_from_board, T* residual) const {
    const T in_board[3] = {T(point_in_board.x()), T(point_in_board.y()), T(point_in_board.z())};
    T in_reference[3], in_camera[3], projected[2];
    ceres::AngleAxisRotatePoint(reference_from_board, in_board, in_reference);
    for (int i = 0; i < 3; ++i) in_reference[i] += reference_from_board[3 + i];
    ceres::AngleAxisRotatePoint(camera_from_reference, in_reference, in_camera);
    for (int i = 0; i < 3; ++i) in_camera[i] += camera_from_reference[3 + i];
    if (!project_point<Formula>(lens, in_camera, projected)) return false;
    residual[0] = T(pixel.x()) - projected[0];
    residual[1] = T(pixel.y()) - projected[1];
    return true;
  }

  static ceres::CostFunction* make(const Eigen::Vector3d& point, const Eigen::Vector2d& pixel) {
    return new ceres::AutoDiffCostFunction<Reprojection, 2, kLensSize<Formula>, 6, 6>(new Reprojection{point, pixel});
  }
};

ceres::CostFunction* reprojection(LensModel model, const Eigen::Vector3d& point, const Eigen::Vector2d& pixel) {
  return vision::visit_lens(model, [&]<vision::LensFormula Formula>(const Formula& /*formula*/) {
    return Reprojection<Formula>::make(point, pixel);
  });
}

/// The rig as parameter blocks of a Ceres problem.
class Bundle {
 public:
  Bundle(const Observations& observations, const BundleOptions& options, const Rig& rig)
      : options_(options), rig_(rig), boards_(rig.reference_from_board.size()) {
    for (const auto& camera : rig.cameras) {
      lenses_.push_back(lens_parameters(camera.lens));
      poses_.push_back(to_pose(camera.camera_from_reference));
    }
    for (std::size_t view = 0; view < boards_.size(); ++view) {
      if (rig.reference_from_board[view]) add_view(observations, view);
    }
    for (std::size_t camera = 0; camera < lenses_.size(); ++camera) {
      if (!problem_.HasParameterBlock(lenses_[camera].data())) continue;
      if (options.are_lenses_held) problem_.SetParameterBlockConstant(lenses_[camera].data());
      if (camera == options.reference) problem_.SetParameterBlockConstant(poses_[camera].data());
    }
  }

  bool solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (std::size_t i = 0; i < boards_.size(); ++i) {
      if (rig_.reference_from_board[i]) options.linear_solver_ordering->AddElementToGroup(boards_[i].data(), 0);
    }
    // A group for each block: within a group Ceres orders blocks by address, so results differed between runs in the
    // last digit.
    int group = 0;
    for (std::size_t i = 0; i < lenses_.size(); ++i) {
      if (!problem_.HasParameterBlock(lenses_[i].data())) continue;
      options.linear_solver_ordering->AddElementToGroup(lenses_[i].data(), ++group);
      options.linear_solver_ordering->AddElementToGroup(poses_[i].data(), ++group);
    }
    options.max_num_iterations = kMaxSteps;
    options.max_trust_region_radius = kMaxTrust;
    options.function_tolerance = 1e-10;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  Rig result() const {
    Rig rig = rig_;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      rig.cameras[i].lens = with_parameters(rig.cameras[i].lens, lenses_[i]);
      rig.cameras[i].camera_from_reference = to_isometry(poses_[i]);
    }
    for (std::size_t i = 0; i < boards_.size(); ++i) {
      if (rig.reference_from_board[i]) rig.reference_from_board[i] = to_isometry(boards_[i]);
    }
    return rig;
  }

  std::optional<std::vector<CameraSigmas>> sigmas() {
    const auto blocks = free_blocks();
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::SPARSE_QR;
    options.num_threads = 1;
    ceres::Covariance covariance(options);
    if (blocks.empty() || !covariance.Compute(blocks, &problem_)) return std::nullopt;
    const double unit = unit_sigma_px();
    const auto sigmas_of = [&](const double* block, Eigen::Index size) -> Eigen::VectorXd {
      if (!problem_.HasParameterBlock(block) || problem_.IsParameterBlockConstant(block))
        return Eigen::VectorXd::Zero(size);
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> of_block(size, size);
      covariance.GetCovarianceBlock(block, block, of_block.data());
      return unit * of_block.diagonal().cwiseSqrt();
    };
    std::vector<CameraSigmas> all;
    for (std::size_t i = 0; i < lenses_.size(); ++i) {
      const Eigen::VectorXd pose = sigmas_of(poses_[i].data(), 6);
      all.push_back({sigmas_of(lenses_[i].data(), lenses_[i].size()), pose.tail<3>(), pose.head<3>()});
    }
    return all;
  }

 private:
  void add_view(const Observations& observations, std::size_t view) {
    boards_[view] = to_pose(*rig_.reference_from_board[view]);
    for (std::size_t camera = 0; camera < lenses_.size(); ++camera) {
      for (const auto& corner : observations.views[view].seen[camera]) {
        const auto& point = observations.board_points[static_cast<std::size_t>(corner.id)];
        auto* loss = options_.loss_px > 0.0 ? new ceres::HuberLoss(options_.loss_px) : nullptr;
        problem_.AddResidualBlock(reprojection(rig_.cameras[camera].lens.model, point, corner.pixel), loss,
                                  lenses_[camera].data(), poses_[camera].data(), boards_[view].data());
      }
    }
  }

  std::vector<std::pair<const double*, const double*>> free_blocks() const {
    std::vector<std::pair<const double*, const double*>> blocks;
    const auto add = [&](const double* block) {
      if (problem_.HasParameterBlock(block) && !problem_.IsParameterBlockConstant(block))
        blocks.emplace_back(block, block);
    };
    for (const auto& lens : lenses_) add(lens.data());
    for (const auto& pose : poses_) add(pose.data());
    return blocks;
  }

  /// Standard deviation of a corner coordinate, from the residuals.
  double unit_sigma_px() {
    double cost = 0.0;
    problem_.Evaluate({}, &cost, nullptr, nullptr, nullptr);
    int free = 0;
    std::vector<double*> blocks;
    problem_.GetParameterBlocks(&blocks);
    for (const auto* block : blocks)
      free += problem_.IsParameterBlockConstant(block) ? 0 : problem_.ParameterBlockSize(block);
    return std::sqrt(2.0 * cost / std::max(1, problem_.NumResiduals() - free));
  }

  BundleOptions options_;
  Rig rig_;
  std::vector<Eigen::VectorXd> lenses_;
  std::vector<Pose> poses_, boards_;
  ceres::Problem problem_;
};

std::optional<Eigen::Vector2d> project(const vision::LensCamera& lens, const Eigen::Vector3d& point) {
  const Eigen::VectorXd parameters = lens_parameters(lens);
  Eigen::Vector2d pixel;
  const bool is_seen = vision::visit_lens(lens.model, [&]<vision::LensFormula Formula>(const Formula& /*formula*/) {
    return project_point<Formula>(parameters.data(), point.data(), pixel.data());
  });
  if (!is_seen) return std::nullopt;
  return pixel;
}

}  // namespace

bool adjust(const Observations& observations, const BundleOptions& options, Rig& rig) {
  Bundle bundle(observations, options, rig);
  if (!bundle.solve()) return false;
  rig = bundle.result();
  return true;
}

std::optional<std::vector<CameraSigmas>> uncertainty(const Observations& observations, const BundleOptions& options,
                                                     const Rig& rig) {
  return Bundle(observations, options, rig).sigmas();
}

std::vector<Residual> residuals(const Observations& observations, const Rig& rig) {
  std::vector<Residual> all;
  for (std::size_t view = 0; view < observations.views.size(); ++view) {
    if (!rig.reference_from_board[view]) continue;
    for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
      const auto& [lens, camera_from_reference] = rig.cameras[camera];
      const auto& corners = observations.views[view].seen[camera];
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto& point = observations.board_points[static_cast<std::size_t>(corners[i].id)];
        const auto pixel = project(lens, camera_from_reference * *rig.reference_from_board[view] * point);
        const Eigen::Vector2d error =
            pixel ? Eigen::Vector2d(corners[i].pixel - *pixel) : Eigen::Vector2d::Constant(kNotSeen_px);
        all.push_back({camera, view, i, corners[i].pixel, error});
      }
    }
  }
  return all;
}

double rms_px(const std::vector<Residual>& residuals) {
  double sum = 0.0;
  for (const auto& residual : residuals) sum += residual.error_px.squaredNorm();
  return residuals.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(residuals.size()));
}

}  // namespace panvo::calibration

// SPDX-License-Identifier: Apache-2.0
#include "bundle_solver.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "observation_model.hpp"

namespace panvo::binocular_odometry {
namespace {

using vision::Vector6d;

const vision::RectifiedStereo kSolverStereo{{400.0, 400.0, 320.0, 240.0, 640, 480}, 0.3};
constexpr double kSigma_px = 0.3;

// A camera that moves past a cloud of points, with its observations.
class Drive {
 public:
  explicit Drive(int frames, int points, double disparity_offset_px = 0.0) {
    std::mt19937 random(11);
    const auto uniform = [&random](double from, double to) {
      return from + (to - from) * static_cast<double>(random() % 1000000) / 1e6;
    };
    for (int i = 0; i < frames; ++i) {
      truth.left_from_world.push_back(
          vision::se3_exp((Vector6d() << 0.05 * i, 0.0, -0.5 * i, 0.0, 0.02 * i, 0.0).finished()));
    }
    truth.fixed_frames = 1;
    for (int p = 0; p < points; ++p) {
      const double z = p % 4 == 0 ? uniform(30.0, 200.0) : uniform(5.0, 15.0);
      truth.points.push_back({Eigen::Isometry3d::Identity(), {uniform(-0.6, 0.6), uniform(-0.4, 0.4), 1.0 / z}});
      for (int i = 0; i < frames; ++i) {
        const auto seen =
            predict(kSolverStereo, truth.left_from_world[static_cast<size_t>(i)], truth.points.back().inverse_depth);
        if (!seen) continue;
        truth.observations.push_back(
            {i, p, *seen + Eigen::Vector3d(0.0, 0.0, disparity_offset_px), Eigen::Vector3d::Constant(1.0 / kSigma_px)});
      }
    }
  }

  // Noisy observations and perturbed initial values.
  BundleProblem disturbed(unsigned seed, bool with_noise = true) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    BundleProblem problem = truth;
    for (auto& observation : problem.observations) {
      if (with_noise) observation.pixel += kSigma_px * Eigen::Vector3d{normal(random), normal(random), normal(random)};
    }
    for (size_t i = 1; i < problem.left_from_world.size(); ++i) {
      Vector6d error;
      for (double& value : error) value = 0.02 * normal(random);
      problem.left_from_world[i] = vision::se3_exp(error) * problem.left_from_world[i];
    }
    for (auto& point : problem.points) point.inverse_depth.z() *= 1.0 + 0.05 * normal(random);
    return problem;
  }

  double pose_error(const BundleProblem& problem) const {
    double worst = 0.0;
    for (size_t i = 0; i < problem.left_from_world.size(); ++i) {
      worst = std::max(worst, vision::se3_log(problem.left_from_world[i] * truth.left_from_world[i].inverse()).norm());
    }
    return worst;
  }

  BundleProblem truth;
};

BundleOptions thorough() {
  BundleOptions options;
  options.max_iterations = 50;
  options.min_improvement = 1e-12;
  return options;
}

TEST(BundleSolver, FindsTheTruthOfPerfectMeasurements) {
  const Drive drive(4, 60);
  BundleProblem problem = drive.disturbed(1, false);
  const BundleSummary summary = solve(kSolverStereo, problem, thorough());
  EXPECT_LT(summary.final_cost, 1e-8);
  EXPECT_LT(drive.pose_error(problem), 1e-6);
}

TEST(BundleSolver, LeavesFixedFramesAlone) {
  const Drive drive(4, 60);
  BundleProblem problem = drive.disturbed(1);
  problem.fixed_frames = 2;
  const auto before = problem.left_from_world;
  solve(kSolverStereo, problem, thorough());
  EXPECT_EQ(problem.left_from_world[0].matrix(), before[0].matrix());
  EXPECT_EQ(problem.left_from_world[1].matrix(), before[1].matrix());
}

TEST(BundleSolver, IsNotLedAstrayByOutliers) {
  const Drive drive(4, 80);
  BundleProblem problem = drive.disturbed(2);
  for (size_t i = 0; i < problem.observations.size(); i += 7) problem.observations[i].pixel.x() += 25.0;
  solve(kSolverStereo, problem, thorough());
  EXPECT_LT(drive.pose_error(problem), 0.02);
}

TEST(BundleSolver, FindsADisparityOffset) {
  const Drive drive(6, 200, 0.25);
  BundleProblem problem = drive.disturbed(3);
  problem.offset_information = 1.0;
  solve(kSolverStereo, problem, thorough());
  EXPECT_NEAR(problem.disparity_offset_px, 0.25, 0.03);
}

// The same cost with automatic derivatives of Ceres.
struct CeresResidual {
  const BundleObservation& observation;
  template <class T>
  bool operator()(const T* pose, const T* point, T* residual) const {
    // Pose: angle-axis and translation of left_from_world; the anchors are the world frame.
    const T ray[3] = {point[0], point[1], T(1.0)};
    T h[3];
    ceres::AngleAxisRotatePoint(pose, ray, h);
    for (int k = 0; k < 3; ++k) h[k] += point[2] * pose[3 + k];
    residual[0] = (kSolverStereo.camera.fx * h[0] / h[2] + kSolverStereo.camera.cx - observation.pixel.x()) *
                  observation.inverse_sigma.x();
    residual[1] = (kSolverStereo.camera.fy * h[1] / h[2] + kSolverStereo.camera.cy - observation.pixel.y()) *
                  observation.inverse_sigma.y();
    residual[2] = (kSolverStereo.camera.fx * kSolverStereo.baseline_m * point[2] / h[2] - observation.pixel.z()) *
                  observation.inverse_sigma.z();
    return true;
  }
};

TEST(BundleSolver, AgreesWithCeres) {
  const Drive drive(5, 60);
  const BundleProblem start = drive.disturbed(4);
  BundleProblem ours = start;
  const BundleSummary summary = solve(kSolverStereo, ours, thorough());

  std::vector<std::array<double, 6>> poses;
  for (const auto& pose : start.left_from_world) {
    const Eigen::Vector3d r = vision::so3_log(pose.linear()), t = pose.translation();
    poses.push_back({r.x(), r.y(), r.z(), t.x(), t.y(), t.z()});
  }
  auto points = start.points;
  ceres::Problem problem;
  for (const auto& observation : start.observations) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<CeresResidual, 3, 6, 3>(new CeresResidual{observation}),
                             new ceres::CauchyLoss(2.0), poses[static_cast<size_t>(observation.frame)].data(),
                             points[static_cast<size_t>(observation.point)].inverse_depth.data());
  }
  problem.SetParameterBlockConstant(poses[0].data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 100;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary theirs;
  ceres::Solve(options, &problem, &theirs);

  EXPECT_NEAR(summary.final_cost, theirs.final_cost, 1e-5 * theirs.final_cost);
  for (size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d r = vision::so3_log(ours.left_from_world[i].linear());
    EXPECT_LT((r - Eigen::Vector3d(poses[i].data())).norm(), 1e-5) << i;
    EXPECT_LT((ours.left_from_world[i].translation() - Eigen::Vector3d(poses[i].data() + 3)).norm(), 1e-4) << i;
  }
}

TEST(BundleSolver, CovarianceAgreesWithMonteCarlo) {
  const Drive drive(3, 60);
  constexpr int kTrials = 200;
  BundleOptions options = thorough();
  options.loss_scale = 50.0;  // nearly quadratic: the covariance is that of Gaussian errors
  double nees = 0.0, variance = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    BundleProblem problem = drive.disturbed(100U + static_cast<unsigned>(trial));
    const BundleSummary summary = solve(kSolverStereo, problem, options);
    ASSERT_EQ(summary.covariance.rows(), 12);
    const vision::Matrix6d last = summary.covariance.bottomRightCorner<6, 6>();
    const Vector6d error = vision::se3_log(drive.truth.left_from_world[2] * problem.left_from_world[2].inverse());
    nees += error.dot(last.inverse() * error) / kTrials;
    variance += summary.variance / kTrials;
  }
  EXPECT_NEAR(nees, 6.0, 0.9);
  EXPECT_NEAR(variance, 1.0, 0.05);
}

// At the minimum no step improves, so that the damping grows until the solver gives up.
TEST(BundleSolver, CovarianceIsTheSameWhenStartedAtTheMinimum) {
  const Drive drive(3, 60);
  BundleOptions options = thorough();
  options.max_iterations = 100;
  options.min_improvement = 0.0;
  BundleProblem problem = drive.disturbed(7);
  const BundleSummary first = solve(kSolverStereo, problem, thorough());
  const BundleSummary again = solve(kSolverStereo, problem, options);
  ASSERT_EQ(again.covariance.rows(), 12);
  EXPECT_TRUE(again.covariance.isApprox(first.covariance, 1e-3));
}

}  // namespace
}  // namespace panvo::binocular_odometry

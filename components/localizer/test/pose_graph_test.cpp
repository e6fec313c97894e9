// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::localizer {
namespace {

Eigen::Isometry3d pose(double x, double y, double yaw) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 0.0);
  pose.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, yaw));
  return pose;
}

vision::Matrix6d covariance(double sigma_m, double sigma_rad) {
  vision::Matrix6d matrix = vision::Matrix6d::Identity();
  matrix.topLeftCorner<3, 3>() *= sigma_m * sigma_m;
  matrix.bottomRightCorner<3, 3>() *= sigma_rad * sigma_rad;
  return matrix;
}

TEST(PoseGraph, SharesTheGapOfALoopOutOverItsEdges) {
  // a square of 10 m whose odometry turns 2 degrees too far at each corner, closed by a sighting of the start
  PoseGraph graph;
  const Eigen::Isometry3d step = pose(10.0, 0.0, M_PI / 2.0 + 2.0 * M_PI / 180.0);
  graph.poses.push_back(pose(0, 0, 0));
  for (int i = 0; i < 4; ++i) {
    graph.poses.push_back(graph.poses.back() * step);
    graph.edges.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(i + 1), step,
                           covariance(0.05, 2.0 * M_PI / 180.0), false});
  }
  graph.priors.push_back({0, pose(0, 0, 0), covariance(1e-3, 1e-4)});
  graph.edges.push_back({0, 4, pose(0, 0, 0), covariance(1e-3, 1e-4), true});
  graph.optimise();
  EXPECT_LT(vision::pose_error(graph.poses[4], pose(0, 0, 0)).norm(), 0.01);
  EXPECT_LT((graph.poses[2].translation() - Eigen::Vector3d(10, 10, 0)).norm(), 0.2);
}

TEST(PoseGraph, HasTheCovarianceOfAChainByHand) {
  PoseGraph graph;
  graph.poses = {pose(0, 0, 0), pose(10, 0, 0)};
  graph.priors.push_back({0, pose(0, 0, 0), covariance(0.1, 0.02)});
  graph.edges.push_back({0, 1, pose(10, 0, 0), covariance(0.2, 0.01), false});
  const auto covariances = graph.covariances();
  ASSERT_TRUE(covariances);
  const auto expected =
      vision::compose_covariance(graph.poses[0], covariance(0.1, 0.02), pose(10, 0, 0), covariance(0.2, 0.01));
  EXPECT_TRUE(covariances->poses[1].isApprox(expected, 1e-6)) << covariances->poses[1] << "\n\n" << expected;
}

TEST(PoseGraph, TakesACovarianceThatIsSemidefiniteUpToRounding) {
  // The position is unknown and correlated with the heading up to the seventh digit, i.e. single precision.
  vision::Matrix6d unknown = covariance(1e6, 1.0);
  unknown(0, 5) = unknown(5, 0) = 1e6 * (1.0 + 1e-7);
  PoseGraph graph;
  graph.poses = {pose(0, 0, 0), pose(10, 0, 0)};
  graph.priors.push_back({0, pose(0, 0, 0), covariance(0.1, 0.02)});
  graph.priors.push_back({1, pose(3, 0, 0), unknown});
  graph.edges.push_back({0, 1, pose(10, 0, 0), covariance(0.2, 0.01), false});
  graph.optimise();
  EXPECT_NEAR(graph.poses[1].translation().x(), 10.0, 1e-3);
}

TEST(PoseGraph, HasCovariancesThatErrorsFollow) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    PoseGraph graph;
    std::vector<Eigen::Isometry3d> truth{pose(0, 0, 0)};
    graph.poses = truth;
    const auto spread = covariance(0.05, 0.01);
    for (std::size_t i = 0; i < 6; ++i) {
      const Eigen::Isometry3d step = pose(5.0, 0.5, 0.4);
      truth.push_back(truth.back() * step);
      Eigen::Isometry3d measured = step;
      measured.translation() += 0.05 * Eigen::Vector3d{normal(random), normal(random), normal(random)};
      measured.linear() =
          vision::so3_exp(0.01 * Eigen::Vector3d{normal(random), normal(random), normal(random)}) * measured.linear();
      graph.poses.push_back(graph.poses.back() * measured);
      graph.edges.push_back({i, i + 1, measured, spread, false});
    }
    graph.priors.push_back({0, truth[0], covariance(1e-4, 1e-4)});
    graph.optimise();
    const auto error = vision::pose_error(graph.poses.back(), truth.back());
    sum += error.dot(graph.covariances()->poses.back().ldlt().solve(error));
  }
  EXPECT_NEAR(sum / kTrials, 6.0, 0.9);
}

TEST(PoseGraph, IsNotPulledByASightingThatIsWrong) {
  PoseGraph graph;
  graph.poses = {pose(0, 0, 0), pose(10, 0, 0), pose(20, 0, 0)};
  graph.priors.push_back({0, pose(0, 0, 0), covariance(1e-3, 1e-4)});
  for (std::size_t i = 0; i < 2; ++i) graph.edges.push_back({i, i + 1, pose(10, 0, 0), covariance(0.1, 0.01), false});
  graph.edges.push_back({0, 2, pose(5, 8, 0), covariance(0.02, 0.005), true});
  graph.optimise();
  EXPECT_LT((graph.poses[2].translation() - Eigen::Vector3d(20, 0, 0)).norm(), 0.5);
}

TEST(PoseGraph, SaysThatWithoutAnchorNothingIsDetermined) {
  PoseGraph graph;
  graph.poses = {pose(0, 0, 0), pose(10, 0, 0)};
  graph.edges.push_back({0, 1, pose(10, 0, 0), covariance(0.1, 0.01), false});
  EXPECT_FALSE(graph.covariances());
}

TEST(PoseGraph, RefusesEdgesToNowhere) {
  PoseGraph graph;
  graph.poses = {pose(0, 0, 0)};
  graph.edges.push_back({0, 7, pose(10, 0, 0), covariance(0.1, 0.01), false});
  EXPECT_THROW(graph.optimise(), std::invalid_argument);
}

TEST(PoseGraph, SaysWhereItFindsNoMinimum) {
  PoseGraph graph;
  graph.poses.assign(2, Eigen::Isometry3d::Identity());
  graph.poses[1].translation().x() = std::nan("");
  graph.edges.push_back({0, 1});
  graph.priors.push_back({0});
  EXPECT_FALSE(graph.optimise());
  EXPECT_TRUE(graph.poses[0].isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace panvo::localizer

// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/pose_refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace panvo::position_corrector {
namespace {

constexpr double kSigma_rad = 0.004;

/// Points around a landmark, seen from a pose; bearings with perpendicular noise of `sigma_rad`.
class Scene {
 public:
  explicit Scene(unsigned seed) : random_(seed) {
    pose.translation() = Eigen::Vector3d(1.5, -0.1, -2.0);
    pose.linear() = vision::so3_exp(Eigen::Vector3d(0.03, 2.1, -0.02));
  }

  SightedPoint sight(double sigma_rad, double point_sigma_m = 0.0) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const double azimuth = M_PI * any(random_);
    const double range = 15.0 + 10.0 * any(random_);
    const Eigen::Vector3d point(range * std::sin(azimuth), -2.0 + 3.0 * any(random_), range * std::cos(azimuth));
    std::normal_distribution<double> normal;
    const auto noise = [&](double sigma) -> Eigen::Vector3d {
      return sigma * Eigen::Vector3d{normal(random_), normal(random_), normal(random_)};
    };
    const Eigen::Vector3d seen = (pose.inverse() * point).normalized();
    return {point + noise(point_sigma_m), point_sigma_m * point_sigma_m * Eigen::Matrix3d::Identity(),
            (seen + noise(sigma_rad)).normalized()};
  }

  std::vector<SightedPoint> sights(int count, double sigma_rad, double point_sigma_m = 0.0) {
    std::vector<SightedPoint> all;
    for (int i = 0; i < count; ++i) all.push_back(sight(sigma_rad, point_sigma_m));
    return all;
  }

  Eigen::Isometry3d near() const {
    Eigen::Isometry3d start = pose;
    start.translation() += Eigen::Vector3d(0.8, 0.3, -0.7);
    start.linear() = vision::so3_exp(Eigen::Vector3d(0.05, -0.1, 0.04)) * start.linear();
    return start;
  }

  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();

 private:
  std::mt19937_64 random_;
};

TEST(PoseRefinement, FindsThePoseThatExactBearingsWereSeenFrom) {
  Scene scene(1);
  const auto refined = refine_pose(scene.near(), scene.sights(30, 0.0), kSigma_rad);
  EXPECT_LT(vision::pose_error(refined.landmark_from_panorama, scene.pose).norm(), 1e-6);
}

TEST(PoseRefinement, HasACovarianceThatTheErrorsFollow) {
  double sum = 0.0;
  constexpr int kTrials = 200;
  for (unsigned trial = 0; trial < kTrials; ++trial) {
    Scene scene(100 + trial);
    const auto refined = refine_pose(scene.near(), scene.sights(40, kSigma_rad, 0.1), kSigma_rad);
    const auto error = vision::pose_error(refined.landmark_from_panorama, scene.pose);
    sum += error.dot(refined.covariance.ldlt().solve(error));
  }
  // six degrees of freedom; the robust loss slightly reduces the weight of good points
  EXPECT_GT(sum / kTrials, 4.0);
  EXPECT_LT(sum / kTrials, 7.0);
}

TEST(PoseRefinement, IsNotPulledAwayByAFifthOfWrongPoints) {
  Scene scene(3);
  auto sights = scene.sights(40, kSigma_rad);
  for (std::size_t i = 0; i < sights.size(); i += 5) {
    sights[i].bearing = vision::so3_exp(Eigen::Vector3d(0.1, 0.3, 0.0)) * sights[i].bearing;
  }
  const auto refined = refine_pose(scene.near(), sights, kSigma_rad);
  EXPECT_LT((refined.landmark_from_panorama.translation() - scene.pose.translation()).norm(), 0.1);
}

TEST(PoseRefinement, SaysThatTwoPointsDetermineNothing) {
  Scene scene(4);
  const auto start = scene.near();
  const auto refined = refine_pose(start, scene.sights(2, 0.0), kSigma_rad);
  EXPECT_TRUE(refined.landmark_from_panorama.isApprox(start));
  EXPECT_GT(refined.covariance.diagonal().minCoeff(), 1e5);
}

TEST(PoseRefinement, CountsAPointBehindTheBearingAsInfinitelyFar) {
  Scene scene(5);
  auto behind = scene.sight(0.0);
  EXPECT_LT(squared_residual(behind, scene.pose, kSigma_rad), 1e-12);
  behind.bearing = -behind.bearing;
  EXPECT_TRUE(std::isinf(squared_residual(behind, scene.pose, kSigma_rad)));
}

/// Woods 100 m away, and near points: in a field these alone tell the position.
std::vector<SightedPoint> field(Scene& scene, int near_points) {
  std::vector<SightedPoint> sights;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto add = [&](double azimuth_rad, double range_m, double height_m) {
    const Eigen::Vector3d point(range_m * std::sin(azimuth_rad), -height_m, range_m * std::cos(azimuth_rad));
    const double sigma_m = 0.1 * range_m;
    const Eigen::Vector3d along = point.normalized();
    sights.push_back({point, sigma_m * sigma_m * along * along.transpose() + 1e-4 * Eigen::Matrix3d::Identity(),
                      (scene.pose.inverse() * point +
                       kSigma_rad * range_m * Eigen::Vector3d{normal(random), normal(random), normal(random)})
                          .normalized()});
  };
  for (int i = 0; i < 12; ++i) add(0.2 + 0.1 * i, 100.0 + 7.0 * i, 4.0 + i % 5);
  for (int i = 0; i < near_points; ++i) add(0.3 + 2.0 * i, 9.0 + i, -1.5);
  return sights;
}

TEST(PoseRefinement, TrustsNoPositionThatOneFalseNearPointAmongFarOnesDecides) {
  Scene scene(6);
  auto sights = field(scene, 1);
  sights.back().bearing = vision::so3_exp(Eigen::Vector3d(0.0, 0.25, 0.0)) * sights.back().bearing;
  const auto refined = refine_pose(scene.pose, sights, kSigma_rad);
  const auto error = vision::pose_error(refined.landmark_from_panorama, scene.pose);
  ASSERT_GT(error.head<3>().norm(), 1.0);
  EXPECT_GT(error.dot(refined.covariance.ldlt().solve(error)), 50.0);
  const auto covariance = covariance_without_most_informative(refined, sights, kSigma_rad, 2);
  EXPECT_LT(error.dot(covariance.ldlt().solve(error)), 16.8);  // 99 % of six degrees of freedom
}

TEST(PoseRefinement, TrustsAPositionThatManyPointsTell) {
  Scene scene(7);
  const auto sights = scene.sights(60, kSigma_rad, 0.1);
  const auto refined = refine_pose(scene.near(), sights, kSigma_rad);
  const auto covariance = covariance_without_most_informative(refined, sights, kSigma_rad, 2);
  EXPECT_TRUE(covariance_without_most_informative(refined, sights, kSigma_rad, 0).isApprox(refined.covariance, 1e-4));
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(covariance(i, i), refined.covariance(i, i));
    EXPECT_LT(covariance(i, i), 1.5 * refined.covariance(i, i));
  }
}

TEST(PoseRefinement, KnowsNothingWithoutTheFewPointsThatItHas) {
  Scene scene(8);
  const auto sights = scene.sights(5, kSigma_rad);
  const auto refined = refine_pose(scene.near(), sights, kSigma_rad);
  const auto covariance = covariance_without_most_informative(refined, sights, kSigma_rad, 3);
  EXPECT_GT((covariance.topLeftCorner<3, 3>().trace()), 100.0);
  EXPECT_TRUE(covariance_without_most_informative(refined, sights, kSigma_rad, 9).allFinite());
}

}  // namespace
}  // namespace panvo::position_corrector

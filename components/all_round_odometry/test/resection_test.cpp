// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/resection.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "park.hpp"

namespace panvo::all_round_odometry {
namespace {

Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const vision::Vector6d& error) {
  Eigen::Isometry3d other = pose;
  other.translation() += error.head<3>();
  other.linear() = vision::so3_exp(error.tail<3>()) * pose.linear();
  return other;
}

Eigen::Isometry3d camera_motion() {
  return Eigen::Translation3d(1.5, 0.2, -0.1) * Eigen::Isometry3d(vision::so3_exp({0.02, -0.01, 0.2}));
}

TEST(Residual, HasTheDerivativesOfItsError) {
  const Sighting sighting{
      0, Eigen::Vector3d(0.3, 0.9, 0.2).normalized(), Eigen::Vector3d(0.2, 0.95, 0.25).normalized(), {1e-6, 1e-6}};
  constexpr double kInverse = 0.12, kStep = 1e-6;
  const Eigen::Isometry3d pose = camera_motion();
  const auto residual = residual_of(sighting, kInverse, pose);
  ASSERT_TRUE(residual);
  for (int i = 0; i < 6; ++i) {
    const vision::Vector6d step = kStep * vision::Vector6d::Unit(i);
    const Eigen::Vector2d slope = (residual_of(sighting, kInverse, moved(pose, step))->error -
                                   residual_of(sighting, kInverse, moved(pose, -step))->error) /
                                  (2.0 * kStep);
    EXPECT_LT((residual->by_pose.col(i) - slope).norm(), 1e-7) << i;
  }
  const Eigen::Vector2d slope =
      (residual_of(sighting, kInverse + kStep, pose)->error - residual_of(sighting, kInverse - kStep, pose)->error) /
      (2.0 * kStep);
  EXPECT_LT((residual->by_inverse - slope).norm(), 1e-7);
}

TEST(Residual, IsNotDefinedForAPointInsideTheCamera) {
  const Sighting sighting{0, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX(), {1e-6, 1e-6}};
  EXPECT_FALSE(residual_of(sighting, 1.0, Eigen::Isometry3d(Eigen::Translation3d(1.0, 0.0, 0.0))));
  EXPECT_TRUE(residual_of(sighting, 1.0, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 0.0))));
}

class ResectionInAPark : public ::testing::Test {
 protected:
  /// Sightings in panorama `now` of the points of panorama 0, of known distance but for `unknown` of them.
  void look(int now, std::size_t unknown = 0) {
    truth_ = Eigen::Translation3d(-kCamera) * Park::vehicle(now) * Eigen::Translation3d(kCamera);
    points_ = park_.seen(now, {0}, 150);
    known_.clear();
    for (const Sighting& sighting : points_.tracks[0].sightings) {
      // The distance, from two bearings and the true motion.
      const Eigen::Vector3d now_in_then = truth_.linear() * sighting.now;
      const Eigen::Vector3d across = sighting.then.cross(now_in_then);
      const double inverse = across.squaredNorm() / truth_.translation().cross(now_in_then).dot(across);
      known_.push_back({&sighting, {inverse, 1e-8}, &reference_});
      if (known_.size() <= unknown) known_.back().inverse = {};
    }
  }

  Park park_{3, 1e-5};
  PanoramaPoints points_;
  Eigen::Isometry3d truth_, reference_ = Eigen::Isometry3d::Identity();
  std::vector<KnownSighting> known_;
};

TEST_F(ResectionInAPark, FindsTheCameraInMetres) {
  look(4);
  const auto found = resect(known_, moved(truth_, vision::Vector6d::Constant(0.05)));
  ASSERT_TRUE(found);
  EXPECT_LT((found->local_from_now.translation() - truth_.translation()).norm(), 0.01);
  EXPECT_LT(vision::pose_error(found->local_from_now, truth_).tail<3>().norm(), 1e-3);
  EXPECT_GT(found->agreeing, 140);
  EXPECT_LT(vision::horizontal_sigma(found->covariance), 0.05);
}

TEST_F(ResectionInAPark, PutsUpWithAThirdOfThePointsMoving) {
  look(4);
  for (std::size_t i = 0; i < known_.size(); i += 3) known_[i].inverse.mean += 0.1;
  const auto found = resect(known_, moved(truth_, vision::Vector6d::Constant(0.05)));
  ASSERT_TRUE(found);
  EXPECT_LT((found->local_from_now.translation() - truth_.translation()).norm(), 0.02);
  EXPECT_LT(found->agreeing, 115);
}

TEST_F(ResectionInAPark, KnowsTheDirectionButNotTheWayIfNoDistanceIsKnown) {
  look(4, 150);
  const auto found = resect(known_, moved(truth_, vision::Vector6d::Constant(0.02)));
  ASSERT_TRUE(found);
  EXPECT_LT(vision::pose_error(found->local_from_now, truth_).tail<3>().norm(), 5e-3);
  const Eigen::Vector3d way = truth_.translation().normalized();
  const double along = way.dot(found->covariance.topLeftCorner<3, 3>() * way);
  const Eigen::Vector3d aside = way.cross(Eigen::Vector3d::UnitZ());
  EXPECT_GT(along, 10.0 * aside.dot(found->covariance.topLeftCorner<3, 3>() * aside));
}

TEST_F(ResectionInAPark, CombinesPointsOfSeveralReferences) {
  look(4);
  // The same points, told relative to another camera pose of the local frame.
  const Eigen::Isometry3d elsewhere =
      Eigen::Translation3d(10.0, -5.0, 1.0) * Eigen::Isometry3d(vision::so3_exp({0.0, 0.0, 1.0}));
  const Eigen::Isometry3d then_from_local = elsewhere.inverse();
  for (KnownSighting& known : known_) known.then_from_local = &then_from_local;
  const Eigen::Isometry3d expected = elsewhere * truth_;
  const auto found = resect(known_, moved(expected, vision::Vector6d::Constant(0.05)));
  ASSERT_TRUE(found);
  EXPECT_LT((found->local_from_now.translation() - expected.translation()).norm(), 0.01);
}

}  // namespace
}  // namespace panvo::all_round_odometry

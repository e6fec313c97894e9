// SPDX-License-Identifier: Apache-2.0
#include "panvo/position_corrector/position_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace panvo::position_corrector {
namespace {

/// Extrinsics of a forward-looking camera, `forward_m` ahead of the base and `up_m` above it.
Eigen::Isometry3d mounted(double forward_m, double up_m) {
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  base_from_panorama.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;  // X right, Y down, Z forward
  base_from_panorama.translation() = Eigen::Vector3d(forward_m, 0.0, up_m);
  return base_from_panorama;
}

LandmarkMatch locked_with(const PanoramaPose& pose) {
  LandmarkMatch match;
  match.state = MatchState::kLocked;
  match.stamp_ns = 7;
  match.landmark_id = 3;
  match.inliers = 40;
  match.pose = pose;
  return match;
}

TEST(PositionCorrection, IsOfTheBaseAndNotOfTheCamera) {
  // a quarter turn to the left, 2 m to the right of and 3 m ahead of the landmark's panorama
  PanoramaPose pose;
  pose.landmark_from_panorama.linear() = vision::so3_exp(Eigen::Vector3d(0.0, -M_PI / 2.0, 0.0));
  pose.landmark_from_panorama.translation() = Eigen::Vector3d(2.0, 0.0, 3.0);
  const auto base = to_base(pose, {mounted(0.5, 2.0), mounted(0.5, 2.0)});
  // camera then at (0.5, 0, 2), now 3 m ahead and 2 m to the right; the base is half a metre behind the left-looking
  // camera
  const Eigen::Vector3d expected(3.5, -2.5, 0.0);
  EXPECT_LT((base.landmark_from_base.translation() - expected).norm(), 1e-12);
  EXPECT_LT((base.landmark_from_base.linear() - vision::so3_exp(Eigen::Vector3d(0.0, 0.0, M_PI / 2.0))).norm(), 1e-12);
}

TEST(PositionCorrection, KnowsThatTheCameraWasMountedElsewhereWhenTheLandmarkWasMade) {
  const auto base = to_base({}, {mounted(0.5, 2.0), mounted(-0.2, 1.5)});
  EXPECT_LT((base.landmark_from_base.translation() - Eigen::Vector3d(0.7, 0.0, 0.5)).norm(), 1e-12);
}

TEST(PositionCorrection, HasTheCovarianceOfPosesThatScatterAsThePanoramasDo) {
  PanoramaPose pose;
  pose.landmark_from_panorama.linear() = vision::so3_exp(Eigen::Vector3d(0.05, 1.1, -0.02));
  pose.landmark_from_panorama.translation() = Eigen::Vector3d(2.0, -0.1, 3.0);
  const Mountings mountings{mounted(0.5, 2.0), mounted(1.5, 1.8)};
  // perturbs each direction separately: the covariance is the sum of the resulting errors
  vision::Matrix6d expected = vision::Matrix6d::Zero();
  constexpr double kStep = 1e-6;
  const auto base = to_base(pose, mountings);
  for (int i = 0; i < 6; ++i) {
    vision::Vector6d sigma = vision::Vector6d::Zero();
    sigma[i] = 0.01 * (i + 1);
    pose.covariance(i, i) = sigma[i] * sigma[i];
    PanoramaPose moved = pose;
    moved.landmark_from_panorama.translation() += kStep * sigma.head<3>();
    moved.landmark_from_panorama.linear() =
        vision::so3_exp(kStep * sigma.tail<3>()) * pose.landmark_from_panorama.linear();
    const vision::Vector6d error =
        vision::pose_error(base.landmark_from_base, to_base(moved, mountings).landmark_from_base) / kStep;
    expected += error * error.transpose();
  }
  EXPECT_LT((to_base(pose, mountings).covariance - expected).norm(), 1e-4 * expected.norm());
}

TEST(PositionCorrection, IsWiderAlongTheWayWhereTheStampIsUncertain) {
  BasePose pose;
  pose.landmark_from_base.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, M_PI / 2.0));
  vision::Vector6d twist = vision::Vector6d::Zero();
  twist[0] = 5.0;  // m/s ahead, to the left of the landmark
  twist[5] = 0.5;
  const auto wider = with_uncertain_stamp(pose, twist, 0.02);
  EXPECT_NEAR(wider.covariance(1, 1), 2.0 * 0.1 * 0.1, 1e-12);
  EXPECT_NEAR(wider.covariance(5, 5), 2.0 * 0.01 * 0.01, 1e-12);
  EXPECT_NEAR(wider.covariance(0, 0), 0.0, 1e-12);
  EXPECT_TRUE(with_uncertain_stamp(pose, twist, 0.0).covariance.isZero());
}

TEST(PositionCorrection, IsGivenForAPanoramaThatALockedLandmarkGivesAPose) {
  PanoramaPose pose;
  pose.landmark_from_panorama.translation().z() = 4.0;
  const auto correction = metric_correction(locked_with(pose), {mounted(0.0, 2.0), mounted(0.0, 2.0)});
  ASSERT_TRUE(correction);
  EXPECT_EQ(correction->state, CorrectionState::kFull);
  EXPECT_TRUE(correction->reason.empty());
  EXPECT_EQ(correction->stamp_ns, 7);
  EXPECT_EQ(correction->landmark_id, 3U);
  EXPECT_EQ(correction->inliers, 40);
  EXPECT_NEAR(correction->pose.landmark_from_base.translation().x(), 4.0, 1e-12);
}

TEST(PositionCorrection, IsRejectedWithItsReasonWhereGeometryDoesNotAgree) {
  for (const auto state : {MatchState::kRejected, MatchState::kLocked}) {
    LandmarkMatch match;
    match.state = state;
    match.landmark_id = 2;
    match.inliers = 9;
    match.reason = "9 inliers of 12 needed";
    const auto correction = metric_correction(match, {});
    ASSERT_TRUE(correction);
    EXPECT_EQ(correction->state, CorrectionState::kRejected);
    EXPECT_EQ(correction->reason, "9 inliers of 12 needed");
    EXPECT_EQ(correction->inliers, 9);
  }
}

TEST(PositionCorrection, IsNotGivenASecondTimeWhenTheLandmarkIsPast) {
  auto match = locked_with({});
  for (const auto state : {MatchState::kMatched, MatchState::kSearching, MatchState::kUnusable}) {
    match.state = state;
    EXPECT_FALSE(metric_correction(match, {}));
  }
}

}  // namespace
}  // namespace panvo::position_corrector

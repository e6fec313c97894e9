// SPDX-License-Identifier: Apache-2.0
#include "descriptor_motion.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "panvo/binocular_odometry/binocular_odometry.hpp"
#include "synthetic_scene.hpp"

namespace panvo::binocular_odometry {
namespace {

const vision::RectifiedStereo kSceneStereo = SyntheticScene::stereo();
const vision::StereoMatcher kMatcher(kSceneStereo.camera, {-1.0, 60.0}, 0.8);

StereoPyramids pyramids(const StereoFrame& frame) {
  return {std::make_shared<const vision::ImagePyramid>(frame.left, 4), vision::ImagePyramid(frame.right, 2)};
}

/// A jump of 1.5 m and 12 degrees, along a street of 3 m.
Eigen::Isometry3d jumped() {
  return SyntheticScene::world_from_left(0) *
         vision::se3_exp((vision::Vector6d() << 0.1, 0.0, 1.5, 0.0, 0.21, 0.0).finished());
}

TEST(DescriptorMotion, IsFoundWithoutAPrediction) {
  const Eigen::Isometry3d truth = jumped().inverse() * SyntheticScene::world_from_left(0);
  const auto found =
      DescriptorMotion(kSceneStereo, {})
          .find(pyramids(SyntheticScene::frame(0)), pyramids(SyntheticScene::frame(1, jumped())), kMatcher, {});
  ASSERT_TRUE(found);
  const vision::Vector6d error = vision::pose_error(found->current_from_previous, truth);
  EXPECT_LT(error.head<3>().norm(), 0.05);
  EXPECT_LT(error.tail<3>().norm(), 0.01);
  EXPECT_GE(found->matches.size(), 15u);
  for (const auto& match : found->matches) EXPECT_TRUE(match.previous.has_disparity && match.current.has_disparity);
}

TEST(DescriptorMotion, IsNotFoundBetweenImagesOfDifferentPlaces) {
  auto mirrored = SyntheticScene::frame(1, jumped());
  cv::flip(mirrored.left, mirrored.left, 0);
  cv::flip(mirrored.right, mirrored.right, 0);
  EXPECT_FALSE(
      DescriptorMotion(kSceneStereo, {}).find(pyramids(SyntheticScene::frame(0)), pyramids(mirrored), kMatcher, {}));
  const StereoFrame blank{1, cv::Mat(240, 320, CV_8UC1, cv::Scalar(90)), cv::Mat(240, 320, CV_8UC1, cv::Scalar(90))};
  EXPECT_FALSE(
      DescriptorMotion(kSceneStereo, {}).find(pyramids(SyntheticScene::frame(0)), pyramids(blank), kMatcher, {}));
}

TEST(DescriptorMotion, CarriesTheOdometryOverAJump) {
  BinocularOdometry odometry(kSceneStereo, {});
  odometry.step(SyntheticScene::frame(0));
  odometry.step(SyntheticScene::frame(1));
  const auto estimate = odometry.step(SyntheticScene::frame(2, jumped()));
  EXPECT_TRUE(estimate.quality.reliable) << estimate.quality.reason;
  const Eigen::Isometry3d truth = SyntheticScene::world_from_left(0).inverse() * jumped();
  EXPECT_LT((estimate.odom_from_left.translation() - truth.translation()).norm(), 0.05);
}

}  // namespace
}  // namespace panvo::binocular_odometry

// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/ground_projection.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::landmark_builder {
namespace {

Eigen::Isometry3d tilted() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  pose.linear() = pose.linear() * Eigen::AngleAxisd(0.04, Eigen::Vector3d(0.6, 0.0, 0.8)).toRotationMatrix();
  pose.translation() << -0.25, 0.1, 2.1;
  return pose;
}

TEST(GroundGrid, HasAheadUpAndLeftLeft) {
  const GroundGrid grid{101, 0.25};
  EXPECT_EQ(grid.pixel({0.0, 0.0}), Eigen::Vector2d(50.0, 50.0));
  EXPECT_EQ(grid.pixel({1.0, 0.0}), Eigen::Vector2d(50.0, 46.0));
  EXPECT_EQ(grid.pixel({0.0, 1.0}), Eigen::Vector2d(46.0, 50.0));
  EXPECT_TRUE(grid.point(grid.pixel({3.1, -2.7})).isApprox(Eigen::Vector2d(3.1, -2.7)));
}

TEST(GroundProjection, ShowsAPointOfTheGroundWhereItIsThoughTheCameraIsTilted) {  // [Lu2015 4.1]
  const vision::Equirectangular equirectangular{2160, 1080};
  const GroundProjection projection({}, tilted(), {2160, 1080});
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(6.0, 0.0), Eigen::Vector2d(-4.0, 5.0), Eigen::Vector2d(3.0, -9.0), Eigen::Vector2d(-12.0, 0.02),
        Eigen::Vector2d(-8.0, -8.0)}) {
    cv::Mat panorama(1080, 2160, CV_8UC1, cv::Scalar(0));
    const Eigen::Vector2d seen =
        equirectangular.project(tilted().inverse() * Eigen::Vector3d(point.x(), point.y(), 0.0));
    const cv::Point centre(static_cast<int>(std::lround(seen.x())), static_cast<int>(std::lround(seen.y())));
    for (const int turn : {-2160, 0, 2160}) cv::circle(panorama, centre + cv::Point(turn, 0), 5, 255, cv::FILLED);
    const cv::Mat view = projection.project(panorama);
    const cv::Moments moments = cv::moments(view);
    ASSERT_GT(moments.m00, 0.0) << point.transpose();
    const Eigen::Vector2d found = projection.grid().point({moments.m10 / moments.m00, moments.m01 / moments.m00});
    EXPECT_LT((found - point).norm(), 0.03 * point.norm()) << point.transpose() << " seen at " << found.transpose();
  }
}

TEST(GroundProjection, KeepsTheColours) {
  const GroundProjection projection({}, tilted(), {1080, 540});
  EXPECT_EQ(projection.project(cv::Mat(540, 1080, CV_8UC3, cv::Scalar(10, 20, 30))).at<cv::Vec3b>(40, 90),
            cv::Vec3b(10, 20, 30));
}

TEST(GroundProjection, RefusesWhatIsNoPanoramaOverTheGround) {
  Eigen::Isometry3d under = tilted();
  under.translation().z() = -0.1;
  EXPECT_THROW(GroundProjection({}, under, {1080, 540}), std::invalid_argument);
  EXPECT_THROW(GroundProjection({}, tilted(), {640, 480}), std::invalid_argument);
  EXPECT_THROW(GroundProjection({}, tilted(), {0, 0}), std::invalid_argument);
  const GroundProjection projection({}, tilted(), {1080, 540});
  EXPECT_THROW(projection.project(cv::Mat(270, 540, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW(projection.project(cv::Mat(540, 1080, CV_32FC1)), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::landmark_builder

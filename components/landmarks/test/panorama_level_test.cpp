// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/panorama_level.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::landmarks {
namespace {

constexpr vision::Equirectangular kSphere{720, 360};

/// A camera on the vehicle, turned and tilted.
Eigen::Isometry3d mounted(double left_deg, double down_deg, double roll_deg) {
  Eigen::Isometry3d base_from_panorama = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d ahead;
  ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  base_from_panorama.linear() = vision::so3_exp(left_deg * vision::kDegree * Eigen::Vector3d::UnitZ()) *
                                vision::so3_exp(down_deg * vision::kDegree * Eigen::Vector3d::UnitY()) *
                                vision::so3_exp(roll_deg * vision::kDegree * Eigen::Vector3d::UnitX()) * ahead;
  base_from_panorama.translation() = Eigen::Vector3d(0.3, -0.1, 1.9);
  return base_from_panorama;
}

/// A disc of that grey value where the camera sees a direction of the vehicle's axes.
void paint(const Eigen::Isometry3d& base_from_panorama, const Eigen::Vector3d& direction, int grey, cv::Mat& panorama) {
  const auto pixel = kSphere.project(base_from_panorama.linear().transpose() * direction);
  for (const int turn : {-kSphere.columns, 0, kSphere.columns}) {
    cv::circle(panorama, {cvRound(pixel.x()) + turn, cvRound(pixel.y())}, 7, grey, cv::FILLED);
  }
}

int grey_at(const Eigen::Isometry3d& base_from_panorama, const Eigen::Vector3d& direction, const cv::Mat& panorama) {
  const auto pixel = kSphere.project(base_from_panorama.linear().transpose() * direction);
  return panorama.at<uchar>(cvRound(pixel.y()), cvRound(pixel.x()) % kSphere.columns);
}

TEST(PanoramaLevel, ShowsEachDirectionWhereAnUprightCameraWould) {
  for (const auto& camera : {mounted(30.0, 15.0, -8.0), mounted(-170.0, -20.0, 3.0), mounted(0.0, 0.0, 45.0),
                             mounted(20.0, 3.0, 180.0), mounted(-60.0, -10.0, -125.0)}) {
    PanoramaLevel level(camera);
    ASSERT_TRUE(level.is_tilted());
    EXPECT_NEAR(level.base_from_level().linear()(2, 1), -1.0, 1e-12) << "its y axis points down";
    EXPECT_TRUE(level.base_from_level().translation().isApprox(camera.translation()));
    const Eigen::Vector3d forward = camera.linear().col(2), levelled = level.base_from_level().linear().col(2);
    EXPECT_NEAR(std::atan2(forward.y(), forward.x()), std::atan2(levelled.y(), levelled.x()), 1e-12);
    cv::Mat panorama(kSphere.rows, kSphere.columns, CV_8UC1, cv::Scalar(20));
    std::vector<Eigen::Vector3d> directions;
    for (int i = 0; i < 10; ++i) {
      const double azimuth = 0.6 * i, elevation = 0.1 * (i % 5) - 0.2;
      directions.emplace_back(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                              std::sin(elevation));
      paint(camera, directions.back(), 60 + 15 * i, panorama);
    }
    const cv::Mat upright = level.level(panorama);
    for (int i = 0; i < 10; ++i) {
      EXPECT_NEAR(grey_at(level.base_from_level(), directions[static_cast<std::size_t>(i)], upright), 60 + 15 * i, 1);
    }
  }
}

TEST(PanoramaLevel, LeavesTheImageOfAnUprightCameraAndThatOfOtherAxes) {
  cv::Mat panorama(kSphere.rows, kSphere.columns, CV_8UC3, cv::Scalar(1, 2, 3));
  for (const auto& camera : {mounted(120.0, 1.0, -1.0), Eigen::Isometry3d::Identity()}) {
    PanoramaLevel level(camera);
    EXPECT_FALSE(level.is_tilted());
    EXPECT_EQ(level.level(panorama).data, panorama.data);
    EXPECT_TRUE(level.base_from_level().isApprox(camera));
  }
}

TEST(PanoramaLevel, KeepsTheValuesOfAMask) {
  PanoramaLevel level(mounted(0.0, 10.0, 10.0));
  cv::Mat mask(kSphere.rows, kSphere.columns, CV_8UC1, cv::Scalar(255));
  cv::circle(mask, {200, 250}, 40, 0, cv::FILLED);
  const cv::Mat levelled = level.level_mask(mask);
  EXPECT_EQ(cv::countNonZero(levelled) + cv::countNonZero(levelled == 0), mask.rows * mask.cols);
  EXPECT_EQ(cv::countNonZero((levelled != 0) & (levelled != 255)), 0);
  EXPECT_GT(cv::countNonZero(levelled == 0), 3000);
  EXPECT_TRUE(level.level_mask({}).empty());
}

}  // namespace
}  // namespace panvo::landmarks

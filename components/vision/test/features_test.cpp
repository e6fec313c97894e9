// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "panvo/vision/absolute_orientation.hpp"
#include "panvo/vision/corner_detector.hpp"
#include "panvo/vision/image_check.hpp"
#include "panvo/vision/pose.hpp"
#include "panvo/vision/robust_loss.hpp"
#include "textured_image.hpp"

namespace panvo::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ImagePyramid, HalvesItsCoordinatesFromLevelToLevel) {
  cv::Mat image(256, 256, CV_8UC1);
  for (int v = 0; v < 256; ++v) {
    for (int u = 0; u < 256; ++u) image.at<uchar>(v, u) = static_cast<uchar>(u / 2 + v / 4);
  }
  const ImagePyramid pyramid(image, 4);
  ASSERT_EQ(pyramid.levels(), 4);
  for (int level = 0; level < 4; ++level)
    EXPECT_NEAR(pyramid[level].at<uchar>(64 >> level, 128 >> level), 80, 1) << level;
}

TEST(ImagePyramid, HasNoLevelTooSmallToHoldAPatch) { EXPECT_EQ(ImagePyramid(draw({100, 80}), 6).levels(), 2); }

TEST(DetectCorners, FindsOneInEachFreeCellAndNoneInATakenOne) {
  cv::Mat image(120, 120, CV_8UC1, cv::Scalar(60));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      cv::rectangle(image, {20 + 40 * column, 20 + 40 * row, 14, 14}, cv::Scalar(200), cv::FILLED);
    }
  }
  CellGrid grid(image.size(), 40);
  grid.take({60.0, 60.0});
  EXPECT_EQ(grid.free_cells(), 8);
  const auto corners = detect_corners(ImagePyramid(image, 2), grid, 1.5, 8);
  ASSERT_EQ(corners.size(), 8u);
  for (const Corner& corner : corners) EXPECT_TRUE(grid.is_free(corner.position));
}

TEST(DetectCorners, FindsNothingOnAnEdgeOrAWall) {
  cv::Mat image(120, 120, CV_8UC1, cv::Scalar(60));
  image.colRange(60, 120).setTo(200);
  EXPECT_THAT(detect_corners(ImagePyramid(image, 2), CellGrid(image.size(), 40), 1.5, 8), IsEmpty());
}

TEST(FindFault, NamesWhatIsWrongWithAnImage) {
  const auto even = [](int grey) { return cv::Mat(48, 64, CV_8UC1, cv::Scalar(grey)); };
  EXPECT_THAT(*find_fault(cv::Mat()), HasSubstr("is empty"));
  EXPECT_THAT(*find_fault(cv::Mat(48, 64, CV_8UC3)), HasSubstr("grey"));
  EXPECT_THAT(*find_fault(even(3)), HasSubstr("is black: 100 %"));
  EXPECT_THAT(*find_fault(even(255)), HasSubstr("is saturated: 100 %"));
  EXPECT_THAT(*find_fault(even(120)), HasSubstr("is constant"));
  EXPECT_FALSE(find_fault(draw({64, 48})));
}

TEST(CauchyLoss, WeightIsTheDerivativeOfTheCost) {
  const CauchyLoss loss(2.0);
  for (const double s : {0.0, 0.5, 4.0, 100.0}) {
    EXPECT_NEAR(loss.weight(s), (loss.cost(s + 1e-6) - loss.cost(s)) / 1e-6, 1e-5) << s;
  }
}

class AbsoluteOrientation : public ::testing::Test {
 protected:
  const Eigen::Isometry3d a_from_b_ = se3_exp((Vector6d() << 3.0, -1.0, 0.5, 1.1, -2.0, 0.4).finished());
  std::vector<Eigen::Vector3d> in_b_{{0, 0, 4}, {1, 0, 5}, {0, 2, 6}, {-1, -1, 9}};
  std::vector<Eigen::Vector3d> moved() const {
    std::vector<Eigen::Vector3d> in_a;
    for (const auto& point : in_b_) in_a.push_back(a_from_b_ * point);
    return in_a;
  }
};

TEST_F(AbsoluteOrientation, IsExactForThreePointsAndForMore) {
  for (const size_t count : {3u, 4u}) {
    const auto in_a = moved();
    const auto found =
        absolute_orientation(std::span(in_a).first(count), std::span<const Eigen::Vector3d>(in_b_).first(count));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->isApprox(a_from_b_, 1e-9));
  }
}

TEST_F(AbsoluteOrientation, IsNeverAReflection) {
  auto in_a = in_b_;
  for (auto& point : in_a) point.x() = -point.x();
  const auto found = absolute_orientation(in_a, in_b_);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->linear().determinant(), 1.0, 1e-9);
}

TEST_F(AbsoluteOrientation, RefusesPointsOnALine) {
  in_b_ = {{0, 0, 4}, {1, 0, 5}, {2, 0, 6}};
  EXPECT_FALSE(absolute_orientation(moved(), in_b_));
  EXPECT_FALSE(absolute_orientation(std::span(in_b_).first(2), std::span(in_b_).first(2)));
}

}  // namespace
}  // namespace panvo::vision

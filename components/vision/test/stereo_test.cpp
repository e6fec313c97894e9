// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "panvo/vision/pose.hpp"
#include "panvo/vision/stereo_geometry.hpp"
#include "panvo/vision/stereo_matcher.hpp"
#include "textured_image.hpp"

namespace panvo::vision {
namespace {

const RectifiedStereo kStereo{{400.0, 410.0, 320.0, 240.0, 640, 480}, 0.12};

TEST(StereoGeometry, TriangulatesWhatItObserves) {
  const Eigen::Vector3d point(1.2, -0.7, 6.0);
  const auto again = triangulate(kStereo, observe(kStereo, point));
  ASSERT_TRUE(again);
  EXPECT_LT((*again - point).norm(), 1e-12);
  const Eigen::Vector3d inverse_depth = inverse_depth_point(kStereo, observe(kStereo, point));
  EXPECT_LT((inverse_depth - Eigen::Vector3d(0.2, -0.7 / 6.0, 1.0 / 6.0)).norm(), 1e-12);
}

TEST(StereoGeometry, HasNoPointForADisparityThatIsNotPositive) {
  EXPECT_FALSE(triangulate(kStereo, {100.0, 100.0, 0.0}));
  EXPECT_FALSE(triangulate(kStereo, {100.0, 100.0, -3.0}));
  EXPECT_FALSE(triangulate(kStereo, {100.0, 100.0, std::nan("")}));
}

TEST(StereoGeometry, CovarianceOfAPointAgreesWithMonteCarlo) {
  const Eigen::Vector3d observation(500.0, 100.0, 12.0), sigma(0.3, 0.2, 0.1);
  const Eigen::Vector3d mean = *triangulate(kStereo, observation);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  constexpr int kSamples = 40000;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d error = Eigen::Vector3d{normal(random), normal(random), normal(random)}.cwiseProduct(sigma);
    const Eigen::Vector3d moved = *triangulate(kStereo, observation + error) - mean;
    sampled += moved * moved.transpose() / kSamples;
  }
  const Eigen::Matrix3d predicted = triangulation_covariance(kStereo, observation, sigma);
  EXPECT_LT((sampled - predicted).norm(), 0.04 * predicted.norm());
}

TEST(StereoGeometry, APlaneHasTheDisparitiesOfItsPoints) {
  // A floor 1.3 m below the camera: the disparity grows by baseline over height from row to row.
  const Eigen::Vector3d plane(0.0, 1.0 / 1.3, 0.0);
  const Eigen::Vector3d observation = observe(kStereo, {0.4, 1.3, 5.0});
  const Eigen::Vector2d gradient = disparity_gradient(kStereo, plane);
  EXPECT_NEAR(gradient.y(), 0.12 / 1.3 * 400.0 / 410.0, 1e-12);
  EXPECT_LT((surface_plane(kStereo, observation, gradient) - plane).norm(), 1e-12);
}

TEST(StereoGeometry, APlaneKeepsItsPointsInAnotherFrame) {
  const Eigen::Isometry3d b_from_a = se3_exp((Vector6d() << 0.2, -0.1, 0.5, 0.1, 0.2, -0.05).finished());
  const Eigen::Vector3d plane_in_a(0.05, 0.6, 0.03), point_in_a = plane_in_a / plane_in_a.squaredNorm();
  const auto plane_in_b = transform_plane(b_from_a, plane_in_a);
  ASSERT_TRUE(plane_in_b);
  EXPECT_NEAR(plane_in_b->dot(b_from_a * point_in_a), 1.0, 1e-12);
}

class SlantedStereo : public ::testing::TestWithParam<double> {};

// A pair whose disparity is 9.3 px in row 60 and grows by `slope` from row to row.
TEST_P(SlantedStereo, DisparityAndSlantAreFound) {
  const double slope = GetParam();
  const cv::Size size(200, 120);
  const auto disparity = [slope](double v) { return 9.3 + slope * (v - 60.0); };
  const ImagePyramid left(draw(size), 2);
  const ImagePyramid right(draw(size, [&](double u, double v) { return cv::Point2d(u + disparity(v), v); }), 2);
  const StereoMatcher matcher(kStereo.camera, {-0.5, 60.0}, 0.8);
  const auto match = matcher.search(left, right, {100.0, 60.0});
  ASSERT_TRUE(match);
  // A slant shears the columns that the pyramid smooths along, which leaves an error of a few hundredths of a pixel.
  const double tolerance = 0.03 + 0.1 * slope;
  EXPECT_NEAR(match->disparity_px, 9.3, tolerance);
  EXPECT_NEAR(match->gradient.y(), slope, 0.03);
  EXPECT_NEAR(match->gradient.x(), 0.0, 0.03);
  const auto refined = matcher.refine(left, right, {100.0, 60.0}, 10.5, {0.0, slope});
  ASSERT_TRUE(refined);
  EXPECT_NEAR(refined->disparity_px, 9.3, tolerance);
}

INSTANTIATE_TEST_SUITE_P(FromWallToRoad, SlantedStereo, ::testing::Values(0.0, 0.1, 0.3));

TEST(StereoMatcher, FindsNothingInAnotherPicture) {
  const cv::Size size(200, 120);
  const ImagePyramid left(draw(size), 2);
  const ImagePyramid other(draw(size, [](double u, double v) { return cv::Point2d(1.7 * v + 900.0, 0.6 * u - 500.0); }),
                           2);
  EXPECT_FALSE(StereoMatcher(kStereo.camera, {-0.5, 60.0}, 0.8).search(left, other, {100.0, 60.0}));
}

TEST(StereoMatcher, DoesNotChooseBetweenRepetitions) {
  const cv::Size size(200, 120);
  cv::Mat fence(size, CV_8UC1);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) fence.at<uchar>(v, u) = (u / 6) % 2 == 0 ? 60 : 180;
  }
  const ImagePyramid image(fence, 2);
  EXPECT_FALSE(StereoMatcher(kStereo.camera, {-0.5, 60.0}, 0.8).search(image, image, {100.0, 60.0}));
}

}  // namespace
}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/patch_template.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "textured_image.hpp"

namespace panvo::vision {
namespace {

constexpr double kReach_px = 4.0;
const cv::Size kSize(120, 100);

TEST(PatchTemplate, FindsASubPixelShiftWithoutBias) {
  const cv::Mat source = draw(kSize);
  double worst = 0.0;
  for (const double shift : {0.1, 0.25, 0.5, 0.75, 1.3}) {
    const cv::Mat moved = draw(kSize, [shift](double u, double v) { return cv::Point2d(u - shift, v + 0.6 * shift); });
    const auto patch = PatchTemplate::sample(source, {60.0, 50.0});
    ASSERT_TRUE(patch);
    const auto found = patch->align(moved, {60.0, 50.0}, PatchTemplate::Search::kPlane, kReach_px);
    ASSERT_TRUE(found) << shift;
    worst = std::max(worst, (found->position - Eigen::Vector2d(60.0 + shift, 50.0 - 0.6 * shift)).norm());
    EXPECT_GT(found->correlation, 0.99);
  }
  EXPECT_LT(worst, 0.03);
}

TEST(PatchTemplate, DoesNotMindGainAndOffset) {
  const cv::Mat source = draw(kSize);
  const cv::Mat darker = draw(
      kSize, [](double u, double v) { return cv::Point2d(u - 0.7, v); }, 0.5, 20.0);
  const auto found = PatchTemplate::sample(source, {60.0, 50.0})
                         ->align(darker, {60.0, 50.0}, PatchTemplate::Search::kPlane, kReach_px);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->position.x(), 60.7, 0.05);
  EXPECT_NEAR(found->position.y(), 50.0, 0.05);
}

TEST(PatchTemplate, FollowsAWarpThatItIsTold) {
  const cv::Mat source = draw(kSize);
  Eigen::Matrix2d source_from_target;
  source_from_target << 0.75, 0.1, -0.05, 0.8;
  const Eigen::Vector2d centre(60.0, 50.0), there(55.3, 47.6);
  const cv::Mat target = draw(kSize, [&](double u, double v) {
    const Eigen::Vector2d at = centre + source_from_target * (Eigen::Vector2d(u, v) - there);
    return cv::Point2d(at.x(), at.y());
  });
  const auto found = PatchTemplate::sample(source, centre, source_from_target)
                         ->align(target, there + Eigen::Vector2d(1.0, -0.8), PatchTemplate::Search::kPlane, kReach_px);
  ASSERT_TRUE(found);
  EXPECT_LT((found->position - there).norm(), 0.03);
}

TEST(PatchTemplate, SearchedAlongItsRowStaysOnIt) {
  const cv::Mat source = draw(kSize);
  const cv::Mat moved = draw(kSize, [](double u, double v) { return cv::Point2d(u + 1.4, v); });
  const auto found =
      PatchTemplate::sample(source, {60.0, 50.0})->align(moved, {60.0, 50.0}, PatchTemplate::Search::kRow, kReach_px);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->position.x(), 58.6, 0.03);
  EXPECT_EQ(found->position.y(), 50.0);
}

TEST(PatchTemplate, RefusesAPatchWithoutTextureOrBeyondTheBorder) {
  EXPECT_FALSE(PatchTemplate::sample(cv::Mat(kSize, CV_8UC1, cv::Scalar(90)), {60.0, 50.0}));
  EXPECT_FALSE(PatchTemplate::sample(draw(kSize), {3.0, 50.0}));
  EXPECT_FALSE(PatchTemplate::sample(draw(kSize), {std::nan(""), 50.0}));
}

TEST(PatchTemplate, DoesNotTakeTheNegativeForThePicture) {
  const cv::Mat source = draw(kSize);
  const cv::Mat negative = 255 - source;
  EXPECT_FALSE(PatchTemplate::sample(source, {60.0, 50.0})
                   ->align(negative, {60.0, 50.0}, PatchTemplate::Search::kPlane, kReach_px));
}

TEST(PatchTemplate, VarianceIsThatOfItsErrorsUnderNoise) {
  const cv::Mat source = draw(kSize);
  const auto patch = PatchTemplate::sample(source, {60.0, 50.0});
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 6.0);
  Eigen::Vector2d predicted = Eigen::Vector2d::Zero(), measured = Eigen::Vector2d::Zero();
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    cv::Mat noisy = source.clone();
    for (int v = 40; v < 62; ++v) {
      for (int u = 50; u < 72; ++u)
        noisy.at<uchar>(v, u) = cv::saturate_cast<uchar>(noisy.at<uchar>(v, u) + noise(random));
    }
    const auto found = patch->align(noisy, {60.0, 50.0}, PatchTemplate::Search::kPlane, kReach_px);
    ASSERT_TRUE(found);
    predicted += found->variance / kTrials;
    measured += (found->position - Eigen::Vector2d(60.0, 50.0)).cwiseAbs2() / kTrials;
  }
  // Interpolation averages noise, which reduces the residuals more than the position error.
  EXPECT_NEAR(measured.x() / predicted.x(), 1.0, 0.5);
  EXPECT_NEAR(measured.y() / predicted.y(), 1.0, 0.5);
}

}  // namespace
}  // namespace panvo::vision

// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/view_keypoints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "made_up_keypoints.hpp"
#include "street.hpp"

namespace panvo::stereo_places {
namespace {

const auto kStereo = Street::stereo();

TEST(ViewKeypoints, LieAllOverTheViewAtTheirBearings) {
  const auto image = Street().left(moved(0.0));
  const auto keypoints = detect_view_keypoints(image, kStereo.camera, {});
  ASSERT_GT(keypoints.size(), 150U);
  int left = 0, right = 0;
  for (const auto& keypoint : keypoints) {
    EXPECT_NEAR(static_cast<double>(keypoint.bearing.norm()), 1.0, 1e-5);
    EXPECT_FALSE(keypoint.has_point);
    (keypoint.bearing.x() < 0.0F ? left : right) += 1;
  }
  EXPECT_GT(std::min(left, right), static_cast<int>(keypoints.size()) / 4);
}

TEST(ViewKeypoints, AreTheSameAtHalfTheSize) {
  const auto image = Street().left(moved(0.0));
  cv::Mat twice;
  cv::resize(image, twice, image.size() * 2, 0.0, 0.0, cv::INTER_NEAREST);
  const vision::PinholeCamera wide{440.0, 440.0, 319.5, 239.5, 640, 480};
  ViewKeypointParameters parameters;
  parameters.pixels = 320 * 240;
  const auto small = detect_view_keypoints(image, kStereo.camera, parameters);
  const auto reduced = detect_view_keypoints(twice, wide, parameters);
  ASSERT_EQ(reduced.size(), small.size());
  for (std::size_t i = 0; i < small.size(); ++i) {
    EXPECT_LT((small[i].bearing - reduced[i].bearing).norm(), 1e-5F);
    EXPECT_EQ(small[i].descriptor, reduced[i].descriptor);
  }
}

TEST(ViewKeypoints, RefuseAnImageOfAnotherSize) {
  EXPECT_THROW(detect_view_keypoints(cv::Mat(240, 319, CV_8UC1), kStereo.camera, {}), std::invalid_argument);
}

TEST(ViewKeypoints, GetTheirPointsFromTheDisparity) {
  const Street street;
  const auto left = street.left(moved(0.0));
  auto keypoints = detect_view_keypoints(left, kStereo.camera, {});
  const auto found = keypoints.size();
  ViewDepths(kStereo).keep_measured(keypoints, left, street.right(moved(0.0)));
  ASSERT_GT(keypoints.size(), found / 2);
  int right = 0;
  for (const auto& keypoint : keypoints) {
    const Eigen::Vector3d point = keypoint.point_in_panorama.cast<double>();
    ASSERT_TRUE(keypoint.has_point);
    EXPECT_LT((point.normalized() - keypoint.bearing.cast<double>()).norm(), 1e-5);
    const double range_sigma = point.squaredNorm() * static_cast<double>(keypoint.inverse_range_sigma);
    const double off_m = std::min({std::abs(point.y() - 1.3), std::abs(point.x() + 4.0), std::abs(point.x() - 5.0),
                                   std::abs(point.z() - 18.0), std::abs(point.y() + 4.0)});
    right += off_m < 3.0 * range_sigma ? 1 : 0;
  }
  EXPECT_GT(right, static_cast<int>(0.95 * static_cast<double>(keypoints.size())));
}

TEST(ViewKeypoints, AreLeftOutWithoutAMatchOrTooFarAway) {
  const Street street;
  const auto left = street.left(moved(0.0));
  auto unmatched = detect_view_keypoints(left, kStereo.camera, {});
  auto far = unmatched;
  ViewDepths(kStereo).keep_measured(unmatched, left, Street::of_seed(7).right(moved(0.0)));
  EXPECT_LT(unmatched.size(), far.size() / 10);
  ViewDepths(kStereo).keep_measured(far, left, left);  // no disparity
  EXPECT_TRUE(far.empty());
}

TEST(ViewKeypoints, AreMeasuredAlthoughTheRowsAreOff) {
  const Street street;
  ViewDepths depths(kStereo);
  const cv::Mat down = (cv::Mat_<double>(2, 3) << 1.0, 0.0, 0.0, 0.0, 1.0, 1.5);
  std::size_t first = 0, last = 0;
  for (int i = 0; i < 6; ++i) {
    const auto left = street.left(moved(i));
    cv::Mat right;
    cv::warpAffine(street.right(moved(i)), right, down, left.size());
    auto keypoints = detect_view_keypoints(left, kStereo.camera, {});
    const auto found = keypoints.size();
    depths.keep_measured(keypoints, left, right);
    last = 100 * keypoints.size() / found;
    if (i == 0) first = last;
  }
  EXPECT_GT(last, first + 10) << "percent";
  EXPECT_GT(last, 50U);
}

}  // namespace
}  // namespace panvo::stereo_places

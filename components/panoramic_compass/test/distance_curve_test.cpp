// SPDX-License-Identifier: Apache-2.0
#include "panvo/panoramic_compass/distance_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "painted_panorama.hpp"
#include "panvo/panoramic_compass/feature_patch.hpp"

namespace panvo::panoramic_compass {
namespace {

TEST(DistanceCurve, HasItsMinimumBetweenColumns) {
  DistanceCurve curve{-3, {}};
  for (int u = -3; u <= 3; ++u) curve.distances.push_back(static_cast<float>(0.1 + 0.02 * std::pow(u - 0.4, 2)));
  const auto minimum = find_minimum(curve);
  ASSERT_TRUE(minimum);
  EXPECT_NEAR(minimum->displacement, 0.4, 1e-5);
  EXPECT_NEAR(minimum->distance, 0.1, 1e-5);
  EXPECT_NEAR(minimum->curvature, 0.04, 1e-5);
  EXPECT_FALSE(minimum->at_border);
}

TEST(DistanceCurve, SaysThatItsMinimumMayLieBeyond) {
  EXPECT_TRUE(find_minimum({0, {0.1F, 0.2F, 0.3F}})->at_border);
  EXPECT_TRUE(find_minimum({0, {0.3F, 0.2F, 0.1F}})->at_border);
  EXPECT_FALSE(find_minimum({0, {0.1F, 0.2F}}));
}

FeaturePatchParameters of_patch() {
  FeaturePatchParameters parameters;
  parameters.bounds = {{10, 10}, {30, 30}};
  parameters.selection.kept = 50;
  parameters.selection.alpha_px = 6.0;
  parameters.selection.beta_px = 12.0;
  parameters.selection.gamma_px = 45.0;
  return parameters;
}

// [Lu2015 Eq. 11]: 0 for an unchanged patch, smallest at the new position of the patch, near its mean elsewhere.
TEST(FeaturePatch, IsFoundWhereItWent) {
  const cv::Mat band = paint_panorama().rowRange(140, 290);
  FeaturePatch patch(band.size(), {1000, 20, 150, 100}, of_patch(), 1);  // across the seam
  const FeatureBand then(band, patch.widest()), now(turned_left(band, 23.0), patch.widest());
  EXPECT_FALSE(patch.is_described());
  EXPECT_EQ(patch.distances(then, 0, 1).distances[0], 1.0F);
  patch.describe(then);
  ASSERT_TRUE(patch.is_described());
  EXPECT_NEAR(patch.distances(then, 0, 1).distances[0], 0.0, 1e-6);
  const auto found = find_minimum(patch.distances(now, -60, 121));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->displacement, 23.0, 0.2);
  EXPECT_LT(found->relative, 0.2);
  const auto lifted = find_minimum(patch.distances(now, -60, 121, 12));
  EXPECT_GT(lifted->distance, found->distance);
}

// [Lu2015 Eqs. 6-8]: no features are selected in uniform areas.
TEST(FeaturePatch, HasNoFeaturesInAnEvenSky) {
  const cv::Mat sky(150, kColumns, CV_8UC1, cv::Scalar(220));
  FeaturePatch patch(sky.size(), {200, 20, 150, 100}, of_patch(), 1);
  patch.describe({sky, patch.widest()});
  EXPECT_FALSE(patch.is_described());
}

TEST(FeaturePatch, NeedsRoomForItsRectangles) {
  EXPECT_THROW(FeaturePatch(cv::Size(kColumns, 150), {0, 0, 20, 20}, of_patch(), 1), std::invalid_argument);
}

}  // namespace
}  // namespace panvo::panoramic_compass

// SPDX-License-Identifier: Apache-2.0
#include "panvo/stereo_places/disparity_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "made_up_keypoints.hpp"
#include "street.hpp"

namespace panvo::stereo_places {
namespace {

constexpr double kBearingSigma_rad = 0.003;

/// The place as a pair of cameras measures it whose disparities are too large.
std::vector<landmarks::Keypoint> measured(std::vector<landmarks::Keypoint> place, double offset_px) {
  const auto stereo = Street::stereo();
  for (auto& keypoint : place) {
    const auto depth_m = static_cast<double>(keypoint.point_in_panorama.z());
    const double disparity_px = stereo.camera.fx * stereo.baseline_m / depth_m + offset_px;
    keypoint.point_in_panorama *= static_cast<float>(stereo.camera.fx * stereo.baseline_m / disparity_px / depth_m);
  }
  return place;
}

class DisparityOffsetTest : public testing::Test {
 protected:
  /// Drives past places whose disparities are too large by this much.
  void drive(int places, double by_px, double path_scale = 1.0) {
    for (int i = 0; i < places; ++i) {
      const auto place = made_up_place(static_cast<unsigned>(i + 1));
      offset.begin(measured(place, by_px - offset.px()), moved(100.0 * i));
      for (int j = 1; j <= 3; ++j) {
        offset.add(seen_from(place, moved(1.3 * j, 0.05, 0.2)),
                   moved(100.0 * i) * moved(1.3 * path_scale * j, 0.05, 0.2));
      }
    }
  }
  DisparityOffset offset{Street::stereo(), kBearingSigma_rad};
};

TEST_F(DisparityOffsetTest, IsFoundAlongThePath) {
  for (const double by_px : {0.4, -0.3, 0.0}) {
    offset = DisparityOffset(Street::stereo(), kBearingSigma_rad);
    drive(8, by_px);
    EXPECT_NEAR(offset.px(), by_px, 0.03);
    EXPECT_LT(offset.sigma_px(), 0.05);
  }
}

TEST_F(DisparityOffsetTest, IsUnknownAtFirstAndAtStandstill) {
  EXPECT_EQ(offset.px(), 0.0);
  const double sigma_px = offset.sigma_px();
  const auto place = made_up_place(1);
  offset.begin(measured(place, 0.4), moved(0.0));
  for (int i = 0; i < 10; ++i) offset.add(seen_from(place, moved(0.0)), moved(0.0));
  EXPECT_EQ(offset.px(), 0.0);
  EXPECT_EQ(offset.sigma_px(), sigma_px);
}

TEST_F(DisparityOffsetTest, IgnoresViewsOfOtherPlaces) {
  offset.begin(measured(made_up_place(1), 0.4), moved(0.0));
  for (unsigned seed = 2; seed < 10; ++seed) offset.add(seen_from(made_up_place(seed), moved(2.0)), moved(2.0));
  EXPECT_EQ(offset.px(), 0.0);
}

TEST_F(DisparityOffsetTest, FollowsAWarmingCamera) {
  drive(8, 0.2);
  drive(20, 0.3);
  EXPECT_NEAR(offset.px(), 0.3, 0.05);
}

}  // namespace
}  // namespace panvo::stereo_places

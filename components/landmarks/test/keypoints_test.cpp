// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/keypoints.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "painted_panorama.hpp"

namespace panvo::landmarks {
namespace {

double azimuth(const Keypoint& keypoint) { return std::atan2(keypoint.bearing.x(), keypoint.bearing.z()); }

TEST(DetectKeypoints, FindsAsManyAsAskedForAndUnitBearings) {
  const auto keypoints = detect_keypoints(paint_panorama(1), {});
  ASSERT_GT(keypoints.size(), 100U);
  EXPECT_LE(keypoints.size(), 250U);
  for (const Keypoint& keypoint : keypoints) EXPECT_NEAR(keypoint.bearing.norm(), 1.0, 1e-5);
  EXPECT_EQ(keypoints, detect_keypoints(paint_panorama(1), {}));
}

TEST(DetectKeypoints, FindsNoneWhereThereIsNothingToSee) {
  EXPECT_TRUE(detect_keypoints(cv::Mat(540, 1080, CV_8UC1, cv::Scalar(90)), {}).empty());
}

TEST(MatchKeypoints, FindsThemAgainTurnedByTheHeading) {
  const auto landmark = detect_keypoints(paint_panorama(1), {});
  const double heading = 2.0 * std::numbers::pi * 300 / 1080;
  const auto query = detect_keypoints(turn_left(paint_panorama(1), 300), {});
  for (const auto& window : {std::optional<AzimuthWindow>(), std::optional(AzimuthWindow{heading, 0.1})}) {
    const auto matches = match_keypoints(query, landmark, 0.8F, window);
    EXPECT_GT(matches.size(), landmark.size() / 2);
    int right = 0;
    for (const KeypointMatch& match : matches) {
      const double turned = azimuth(query[static_cast<std::size_t>(match.query)]) -
                            azimuth(landmark[static_cast<std::size_t>(match.landmark)]);
      right += std::abs(vision::wrap(turned - heading, 2.0 * std::numbers::pi)) < 0.003 ? 1 : 0;
    }
    EXPECT_GT(right, 0.95 * static_cast<double>(matches.size()));
  }
  EXPECT_TRUE(match_keypoints(query, {}).empty());
}

TEST(DetectKeypoints, RefusesWhatIsNoPanorama) {
  EXPECT_THROW(detect_keypoints(cv::Mat(), {}), std::invalid_argument);
  EXPECT_THROW(detect_keypoints(cv::Mat(500, 900, CV_8UC1), {}), std::invalid_argument);
}

TEST(Keypoints, StayOutOfTheMaskAndOffItsEdge) {
  cv::Mat mask(540, 1080, CV_8UC1, cv::Scalar(255));
  mask.rowRange(280, 540).setTo(0);
  const auto all = detect_keypoints(paint_panorama(5), {});
  const auto kept = detect_keypoints(paint_panorama(5), {}, mask);
  const auto lowest_row = [](const Keypoint& keypoint) {
    return vision::Equirectangular{1080, 540}.project(keypoint.bearing.cast<double>()).y() +
           static_cast<double>(keypoint.size_px);
  };
  const auto is_low = [&](const Keypoint& keypoint) { return lowest_row(keypoint) > 281.0; };
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), is_low));
  EXPECT_FALSE(kept.empty());
  EXPECT_TRUE(std::none_of(kept.begin(), kept.end(), is_low));
}

TEST(Keypoints, AreDescribedRelativeToTheVerticalUnlessTheyTurnWithTheImage) {
  cv::Mat upside_down;
  cv::flip(paint_panorama(1), upside_down, -1);
  const auto matches = [&](const KeypointParameters& parameters) {
    return match_keypoints(detect_keypoints(upside_down, parameters), detect_keypoints(paint_panorama(1), parameters))
        .size();
  };
  KeypointParameters turning;
  turning.upright = false;
  EXPECT_GT(matches(turning), 50U);
  EXPECT_LT(matches({}), matches(turning) / 4);
}

TEST(LandmarkSettings, TellDescriptorsThatTurnWithTheImage) {
  KeypointParameters turning;
  turning.upright = false;
  EXPECT_EQ(landmark_settings({}, turning, 7), description_settings(DescriptionParameters{}, 7))
      << "stores of versions without upright descriptors";
  EXPECT_THAT(differences(landmark_settings({}, turning, 7), landmark_settings({}, {}, 7)),
              testing::ElementsAre("upright_keypoints is not set there, true here"));
}

}  // namespace
}  // namespace panvo::landmarks

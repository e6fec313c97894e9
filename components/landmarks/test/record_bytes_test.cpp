// SPDX-License-Identifier: Apache-2.0
#include "record_bytes.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "made_up_landmark.hpp"

namespace panvo::landmarks {
namespace {

TEST(RecordBytes, AreLittleEndianWithoutGaps) {
  const AdaptiveFeature feature{0x0102, 1.0f, -2.0f, 0.5f};
  const Bytes expected{0x02, 0x01, 0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0, 0x3f};
  EXPECT_EQ(to_bytes(std::span(&feature, 1)), expected);
}

TEST(RecordBytes, GiveBackWhatWasWrittenToTheLastBit) {
  const auto landmark = test::made_up_landmark(3);
  EXPECT_EQ(floats_from(to_bytes(std::span(landmark.description.histogram))), landmark.description.histogram);
  EXPECT_EQ(features_from(to_bytes(std::span(landmark.description.large))), landmark.description.large);
  EXPECT_EQ(keypoints_from(to_bytes(std::span(landmark.keypoints))), landmark.keypoints);
  const std::vector<double> numbers{0.1, -1e300, 0.0};
  EXPECT_EQ(doubles_from(to_bytes(std::span(numbers))), numbers);
  EXPECT_EQ(keypoints_from({}), std::vector<Keypoint>{});
}

TEST(RecordBytes, TakeTheRoomTheyArePromisedToTake) {
  const auto landmark = test::made_up_landmark(3, 20);
  EXPECT_EQ(to_bytes(std::span(landmark.description.large)).size(), 100u * 14u);
  EXPECT_EQ(to_bytes(std::span(landmark.keypoints)).size(), 10u * 145u + 10u * 161u);
}

TEST(RecordBytes, CutOffAnywhereAreRefusedOrFewer) {
  const auto whole = test::made_up_landmark(3, 4);
  const auto keypoints = to_bytes(std::span(whole.keypoints));
  for (std::size_t size = 1; size < keypoints.size(); ++size) {
    const auto read = keypoints_from(std::span(keypoints).first(size));
    const bool at_a_seam = size == 161 || size == 161 + 145 || size == 2 * 161 + 145;
    EXPECT_EQ(read.has_value(), at_a_seam) << size;
  }
  const auto features = to_bytes(std::span(whole.description.large));
  EXPECT_FALSE(features_from(std::span(features).first(13)));
  EXPECT_FALSE(features_from(std::span(features).first(15)));
}

TEST(RecordBytes, ThatHoldNoNumbersAreRefused) {
  const float values[] = {0.0f, std::numeric_limits<float>::quiet_NaN()};
  EXPECT_FALSE(floats_from(to_bytes(std::span(values))));
  const double infinite[] = {std::numeric_limits<double>::infinity()};
  EXPECT_FALSE(doubles_from(to_bytes(std::span(infinite))));
}

}  // namespace
}  // namespace panvo::landmarks

// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/frame_gaps.hpp"

#include <gtest/gtest.h>

namespace panvo::camera_stream {
namespace {

std::int64_t missing(FrameGaps& gaps, std::initializer_list<std::uint64_t> numbers) {
  std::int64_t sum = 0;
  for (const std::uint64_t number : numbers) sum += gaps.missing_before(number);
  return sum;
}

TEST(FrameGaps, OfGigEVisionWrapFrom65535To1) {
  FrameGaps gaps(FrameNumbering::kGigEVision);
  EXPECT_EQ(missing(gaps, {65533, 65534, 65535, 1, 2}), 0);
  FrameGaps over_the_wrap(FrameNumbering::kGigEVision);
  EXPECT_EQ(missing(over_the_wrap, {65534, 2}), 2);  // 65535 and 1
}

TEST(FrameGaps, AreCounted) {
  FrameGaps gaps(FrameNumbering::kGigEVision);
  EXPECT_EQ(gaps.missing_before(65400), 0);
  EXPECT_EQ(gaps.missing_before(65402), 1);
  EXPECT_EQ(gaps.missing_before(65410), 7);
}

TEST(FrameGaps, AreNoneForADeviceThatBeganAnewOrRepeatsANumber) {
  FrameGaps gaps(FrameNumbering::kGigEVision);
  EXPECT_EQ(missing(gaps, {500, 500, 1, 2, 3}), 0);
}

TEST(FrameGaps, OfGigEVision2GoOnPast16Bits) {
  FrameGaps gaps(FrameNumbering::kGigEVision);
  EXPECT_EQ(missing(gaps, {65535, 65536, 65537}), 0);
  EXPECT_EQ(gaps.missing_before(65540), 2);
  EXPECT_EQ(gaps.missing_before(1), 0);  // restarted
}

TEST(FrameGaps, IgnoreFramesThatTheDeviceDoesNotNumber) {
  FrameGaps gaps(FrameNumbering::kGigEVision);
  EXPECT_EQ(missing(gaps, {0, 0, 7, 0, 8}), 0);
}

TEST(FrameGaps, OfA32BitCounterWrapToZero) {
  FrameGaps gaps(FrameNumbering::kCounter32);
  EXPECT_EQ(missing(gaps, {4294967294, 4294967295, 0, 1}), 0);
  EXPECT_EQ(gaps.missing_before(4), 2);
}

TEST(FrameGaps, OfA64BitCounterDoNotWrap) {
  FrameGaps gaps(FrameNumbering::kCounter64);
  EXPECT_EQ(missing(gaps, {0, 1, 65535, 65537}), 65533u + 1);
}

TEST(FrameGaps, AreNoneWhereAFrameOnlyComesLate) {
  FrameGaps gaps(FrameNumbering::kGigEVision);
  EXPECT_EQ(missing(gaps, {65533, 65534, 1, 2, 65535, 3}), 0);
  EXPECT_EQ(missing(gaps, {5, 6, 8, 4, 9}), 1);  // 7; 4 was late
}

TEST(FrameGaps, AreForgottenWhenTheStreamBeginsAnew) {
  FrameGaps gaps(FrameNumbering::kGigEVision);
  gaps.missing_before(10);
  gaps.restart();
  EXPECT_EQ(gaps.missing_before(100), 0);
}

}  // namespace
}  // namespace panvo::camera_stream

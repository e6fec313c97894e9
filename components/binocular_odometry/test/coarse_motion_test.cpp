// SPDX-License-Identifier: Apache-2.0
#include "coarse_motion.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace panvo::binocular_odometry {
namespace {

Track track(std::int64_t id, double u, bool has_disparity = true) {
  Track track;
  track.id = track.seen.track_id = id;
  track.seen.pixel.x() = u;
  track.seen.has_disparity = has_disparity;
  return track;
}

TEST(FramePair, PairsTracksOfBothFramesThatHadADisparityInTheFirst) {
  const std::vector<Track> before{track(1, 10.0), track(3, 30.0), track(4, 40.0, false), track(6, 60.0)};
  const std::vector<Track> now{track(2, 21.0), track(3, 31.0, false), track(4, 41.0), track(6, 61.0), track(9, 91.0)};
  const auto points = seen_twice(before, now);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].previous.pixel.x(), 30.0);
  EXPECT_EQ(points[0].current.pixel.x(), 31.0);
  EXPECT_FALSE(points[0].current.has_disparity);
  EXPECT_EQ(points[1].previous.pixel.x(), 60.0);
  EXPECT_EQ(points[1].current.pixel.x(), 61.0);
}

TEST(FramePair, IsEmptyForAnEmptyFrame) {
  const std::vector<Track> some{track(1, 10.0)};
  EXPECT_TRUE(seen_twice({}, some).empty());
  EXPECT_TRUE(seen_twice(some, {}).empty());
}

}  // namespace
}  // namespace panvo::binocular_odometry

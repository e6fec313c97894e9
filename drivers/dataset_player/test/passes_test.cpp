// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/passes.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace panvo::dataset_player {
namespace {

using Kind = TimelineEvent::Kind;
using Played = std::tuple<std::int64_t, Kind, std::size_t>;

/// Ground truth from 0 to 40, stereo at 10, 20, 30, a panorama at 10 and 30.
std::vector<TimelineEvent> drive() {
  return {{0, Kind::kGroundTruth, 0}, {10, Kind::kGroundTruth, 1}, {10, Kind::kStereo, 0},
          {10, Kind::kPanorama, 0},   {20, Kind::kStereo, 1},      {30, Kind::kGroundTruth, 2},
          {30, Kind::kStereo, 2},     {30, Kind::kPanorama, 1},    {40, Kind::kGroundTruth, 3}};
}

std::vector<Played> played(std::uint64_t count) {
  const Passes passes(drive(), count);
  std::vector<Played> events;
  for (std::uint64_t i = 0; i < passes.size(); ++i)
    events.emplace_back(passes[i].stamp_ns, passes[i].kind, passes[i].index);
  return events;
}

TEST(Passes, OfOneAreTheRecordingItself) {
  const auto events = played(1);
  ASSERT_EQ(events.size(), drive().size());
  for (std::size_t i = 0; i < events.size(); ++i)
    EXPECT_EQ(events[i], Played(drive()[i].stamp_ns, drive()[i].kind, drive()[i].index));
}

TEST(Passes, TurnAtTheImagesOfBothEndsAndPlayThoseOnce) {
  const std::vector<Played> expected{
      {0, Kind::kGroundTruth, 0}, {10, Kind::kGroundTruth, 1}, {10, Kind::kStereo, 0}, {10, Kind::kPanorama, 0},
      {20, Kind::kStereo, 1},     {30, Kind::kGroundTruth, 2}, {30, Kind::kStereo, 2}, {30, Kind::kPanorama, 1},
      {40, Kind::kStereo, 1},     {50, Kind::kGroundTruth, 1}, {50, Kind::kStereo, 0}, {50, Kind::kPanorama, 0},
      {60, Kind::kStereo, 1},     {70, Kind::kGroundTruth, 2}, {70, Kind::kStereo, 2}, {70, Kind::kPanorama, 1},
      {80, Kind::kStereo, 1},     {90, Kind::kGroundTruth, 1}, {90, Kind::kStereo, 0}, {90, Kind::kPanorama, 0}};
  EXPECT_EQ(played(4), expected);
}

TEST(Passes, MustEndBeforeStampsDo) {
  constexpr std::int64_t kYear_ns = 31'557'600'000'000'000;
  const std::vector<TimelineEvent> two_years{{kYear_ns, Kind::kStereo, 0}, {3 * kYear_ns, Kind::kStereo, 1}};
  const Passes last(two_years, 33);  // until 1970 + 67
  EXPECT_EQ(last[last.size() - 1].stamp_ns, 67 * kYear_ns);
  EXPECT_THROW(Passes(two_years, 34), DatasetError);
  const std::vector<TimelineEvent> whole{{0, Kind::kStereo, 0}, {68 * kYear_ns, Kind::kStereo, 1}};
  EXPECT_THROW(Passes(whole, 1'000'000), DatasetError);
}

}  // namespace
}  // namespace panvo::dataset_player

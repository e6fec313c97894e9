// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/timeline.hpp"

#include <gmock/gmock.h>

namespace panvo::dataset_player {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Kind = TimelineEvent::Kind;

MATCHER_P3(IsEvent, stamp_s, kind, index, "") {
  return arg.stamp_ns == static_cast<std::int64_t>(stamp_s * 1e9) && arg.kind == kind &&
         arg.index == static_cast<std::size_t>(index);
}

/// Stereo at 10, 11, 12, 13 s, panoramas at 10 and 12 s, ground truth each half second from 9 to 15 s.
Dataset recording() {
  Dataset dataset;
  dataset.directory = "campus";
  dataset.stereo.emplace();
  dataset.panorama.emplace();
  constexpr std::int64_t kSecond = 1'000'000'000;
  for (int i = 0; i < 4; ++i) dataset.stereo->frames.push_back({(10 + i) * kSecond, "l", "r"});
  for (int i = 0; i < 2; ++i) dataset.panorama->frames.push_back({(10 + 2 * i) * kSecond, "p"});
  for (int i = 0; i <= 12; ++i)
    dataset.ground_truth.push_back({9 * kSecond + i * kSecond / 2, Eigen::Isometry3d::Identity()});
  return dataset;
}

TEST(Timeline, IsInOrderOfTimeAndEnclosedByGroundTruth) {
  auto dataset = recording();
  dataset.ground_truth.erase(dataset.ground_truth.begin() + 3,
                             dataset.ground_truth.end() - 4);  // leaves 9 to 10, 13.5 to 15 s
  EXPECT_THAT(timeline(dataset, {}),
              ElementsAre(IsEvent(10.0, Kind::kGroundTruth, 2), IsEvent(10.0, Kind::kStereo, 0),
                          IsEvent(10.0, Kind::kPanorama, 0), IsEvent(11.0, Kind::kStereo, 1),
                          IsEvent(12.0, Kind::kStereo, 2), IsEvent(12.0, Kind::kPanorama, 1),
                          IsEvent(13.0, Kind::kStereo, 3), IsEvent(13.5, Kind::kGroundTruth, 3)));
}

TEST(Timeline, IsCutToTheTimeAskedFor) {
  const auto events = timeline(recording(), {.start_s = 0.75, .duration_s = 1.5, .panorama = false});
  EXPECT_THAT(events, ElementsAre(IsEvent(11.0, Kind::kGroundTruth, 4), IsEvent(11.0, Kind::kStereo, 1),
                                  IsEvent(11.5, Kind::kGroundTruth, 5), IsEvent(12.0, Kind::kGroundTruth, 6),
                                  IsEvent(12.0, Kind::kStereo, 2)));
}

TEST(Timeline, HoldsWhatWasAskedForOnly) {
  const auto events = timeline(recording(), {.stereo = false});
  for (const auto& event : events) EXPECT_NE(event.kind, Kind::kStereo);
}

TEST(Timeline, MustNotBeEmpty) {
  const auto message = [](const Dataset& dataset, const Selection& selection) {
    try {
      timeline(dataset, selection);
    } catch (const DatasetError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(recording(), {.start_s = 60.0}), HasSubstr("the recording lasts 3 s"));
  EXPECT_THAT(message(recording(), {.stereo = false, .panorama = false}), HasSubstr("parameter cameras"));
}

}  // namespace
}  // namespace panvo::dataset_player

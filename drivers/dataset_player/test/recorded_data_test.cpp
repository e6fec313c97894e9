// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/dataset_player/dataset.hpp"
#include "panvo/dataset_player/image_file.hpp"
#include "panvo/test/recorded_data.hpp"

namespace panvo::dataset_player {
namespace {

TEST(RecordedData, OfKittiIsReadWhole) {
  const auto path = panvo::test::recorded_data("kitti_03");
  PANVO_NEEDS_RECORDING(path);
  const auto dataset = open_dataset(path);
  EXPECT_EQ(dataset.stereo->frames.size(), 99u);
  EXPECT_EQ(dataset.ground_truth.size(), 99u);
  EXPECT_NEAR(dataset.stereo->rectified.baseline_m, 0.53716, 1e-5);
  EXPECT_EQ(dataset.stereo->rectified.camera.width, 1242);
  // The car drives forward: along +x of base_link.
  EXPECT_GT(dataset.ground_truth.back().map_from_base.translation().x(), 20.0);
}

TEST(RecordedData, OfACampusHasStereoPanoramaAndGroundTruth) {
  const auto path = panvo::test::recorded_data("campus_clip");
  PANVO_NEEDS_RECORDING(path);
  const auto dataset = open_dataset(path);
  EXPECT_EQ(dataset.stereo->frames.size(), 600u);
  EXPECT_EQ(dataset.panorama->frames.size(), 120u);
  EXPECT_EQ(dataset.ground_truth.size(), 707u);
  EXPECT_TRUE(dataset.stereo->rectified.rectified_left_from_left.isIdentity());
  EXPECT_NEAR(dataset.stereo->rectified.baseline_m, 0.12, 1e-6);
  EXPECT_TRUE(dataset.notes.empty());
}

TEST(RecordedData, OfAJourneyHasThePanoramaAlone) {
  const auto path = panvo::test::recorded_data("campus_journey");
  PANVO_NEEDS_RECORDING(path);
  const auto dataset = open_dataset(path);
  EXPECT_FALSE(dataset.stereo);
  EXPECT_EQ(dataset.panorama->frames.size(), 647u);
}

TEST(RecordedData, OfBoofcvIsReadInBothSpellings) {
  for (const auto& [name, frames] : {std::pair{"boofcv_stereo/library", 346u}, {"boofcv_stereo/backyard", 191u}}) {
    const auto path = panvo::test::recorded_data(name);
    PANVO_NEEDS_RECORDING(path);
    const auto dataset = open_dataset(path);
    EXPECT_EQ(dataset.stereo->frames.size(), frames) << name;
    EXPECT_NEAR(dataset.stereo->rectified.baseline_m, 0.12, 1e-3) << name;
    EXPECT_FALSE(dataset.stereo->rectified.rectified_left_from_left.isIdentity()) << name;
  }
}

}  // namespace
}  // namespace panvo::dataset_player

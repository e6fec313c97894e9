// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Folders = testing::WrittenDataset;

TEST_F(Folders, ArePlayedInTheOrderOfNumbersNotOfLetters) {
  write_folders(12);
  const auto frames = open_dataset(root_).stereo->frames;
  ASSERT_EQ(frames.size(), 12u);
  EXPECT_EQ(frames[1].left.filename(), "left2.jpg");
  EXPECT_EQ(frames[11].right.filename(), "right12.jpg");
}

TEST_F(Folders, ArePlayedAtThirtyHertzUnlessSaidOtherwise) {
  write_folders(4);
  const auto dataset = open_dataset(root_);
  EXPECT_EQ(dataset.stereo->frames[3].stamp_ns, 100'000'000);
  EXPECT_THAT(dataset.notes, ElementsAre(AllOf(HasSubstr("30 Hz is assumed"), HasSubstr("rate_hz"))));
  EXPECT_EQ(open_dataset(root_, {.rate_hz = 10.0}).stereo->frames[3].stamp_ns, 300'000'000);
}

TEST_F(Folders, AreNotPlayedSoSlowlyThatMessagesCannotHoldTheirStamps) {
  write_folders(3);
  EXPECT_THROW(open_dataset(root_, {.rate_hz = 1e-12}), DatasetError);
}

TEST_F(Folders, KeepTheTimeOfFramesAfterAGap) {
  write_folders(4);
  fs::remove(root_ / "left/left2.jpg");
  const auto dataset = open_dataset(root_);
  ASSERT_EQ(dataset.stereo->frames.size(), 3u);
  EXPECT_EQ(dataset.stereo->frames[2].stamp_ns, 100'000'000);
  EXPECT_THAT(dataset.notes.front(), AllOf(HasSubstr("1 of 4"), HasSubstr("right/right2.jpg")));
}

TEST_F(Folders, NeedBothEyes) {
  write_folders(2);
  fs::remove_all(root_ / "right");
  EXPECT_THAT(error(), AllOf(HasSubstr("right: is missing"), HasSubstr("both cameras")));
}

TEST_F(Folders, MustNotBeEmpty) {
  write_folders(2);
  fs::remove_all(root_ / "left");
  fs::create_directories(root_ / "left");
  EXPECT_THAT(error(), HasSubstr("left: contains no images"));
}

TEST_F(Folders, MustShareTheirNumbers) {
  write_folders(1);
  fs::rename(root_ / "right/right1.jpg", root_ / "right/right7.jpg");
  EXPECT_THAT(error(), AllOf(HasSubstr("no image has the number"), HasSubstr("equal numbers")));
}

TEST_F(Folders, MustNumberEachImageOnce) {
  write_folders(2);
  write_image("left/left01.jpg");
  EXPECT_THAT(error(), HasSubstr("has the same number as"));
}

TEST_F(Folders, MustNumberTheirImages) {
  write_folders(2);
  write_image("left/portrait.jpg");
  EXPECT_THAT(error(), AllOf(HasSubstr("portrait.jpg"), HasSubstr("does not end in a number")));
}

TEST_F(Folders, NameTheCalibrationsLookedFor) {
  write_folders(2);
  fs::remove(root_ / "stereo_params.xml");
  EXPECT_THAT(error(), AllOf(HasSubstr("stereo_params.xml"), HasSubstr("left.yaml"), HasSubstr("stereo.yaml"),
                             HasSubstr("extrinsics.yml")));
}

TEST_F(Folders, MayBeCalibratedElsewhere) {
  write_folders(2);
  fs::create_directories(root_ / "rig");
  fs::rename(root_ / "stereo_params.xml", root_ / "rig" / "stereo_params.xml");
  EXPECT_NEAR(open_dataset(root_, {.calibration = root_ / "rig"}).stereo->rectified.baseline_m, 0.12, 1e-12);
}

}  // namespace
}  // namespace panvo::dataset_player

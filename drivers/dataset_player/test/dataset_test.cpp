// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/dataset.hpp"

#include <gmock/gmock.h>

#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using OpenDataset = testing::WrittenDataset;

TEST_F(OpenDataset, SaysThatAMissingFolderIsMissing) {
  root_ /= "nowhere";
  EXPECT_THAT(error(), AllOf(HasSubstr(root_.string()), HasSubstr("does not exist")));
}

TEST_F(OpenDataset, SaysThatAFileIsNoFolder) {
  write("readme.txt", "text");
  root_ /= "readme.txt";
  EXPECT_THAT(error(), HasSubstr("is a file; specify the folder"));
}

TEST_F(OpenDataset, NamesAllItLookedForInAnEmptyFolder) {
  EXPECT_THAT(error(), AllOf(HasSubstr(root_.string()), HasSubstr("mav0/cam0"), HasSubstr("calib.txt"),
                             HasSubstr("left/right")));
}

TEST_F(OpenDataset, FindsTheKindByTheLayout) {
  write_kitti();
  EXPECT_EQ(open_dataset(root_).kind, "KITTI odometry");
  write_euroc();
  fs::remove_all(root_ / "image_0");
  EXPECT_EQ(open_dataset(root_).kind, "EuRoC/ASL");
  fs::remove_all(root_ / "mav0");
  fs::remove_all(root_ / "calib.txt");
  write_folders();
  EXPECT_EQ(open_dataset(root_).kind, "left/right folders");
}

TEST_F(OpenDataset, RefusesEyesOfDifferentSize) {
  write_kitti();
  write_image("image_1/000000.png", 32, 48);
  EXPECT_THAT(error(), AllOf(HasSubstr("image_0/000000.png"), HasSubstr("64 x 48"), HasSubstr("32 x 48"),
                             HasSubstr("one size")));
}

TEST_F(OpenDataset, RefusesImagesOfAnotherSizeThanTheCalibration) {
  write_folders();
  for (const char* eye : {"left", "right"}) {
    for (int i = 1; i <= 12; ++i) write_image(fs::path(eye) / (eye + std::to_string(i) + ".jpg"), 80, 60);
  }
  EXPECT_THAT(error(), AllOf(HasSubstr("stereo_params.xml"), HasSubstr("64 x 48"), HasSubstr("80 x 60")));
}

TEST_F(OpenDataset, OutlivesADamagedFirstImage) {
  write_kitti();
  write("image_0/000000.png", "no image");
  EXPECT_EQ(open_dataset(root_).stereo->rectified.camera.width, kWidth);
}

TEST_F(OpenDataset, RefusesImagesOfWhichNoneCanBeDecoded) {
  write_kitti();
  for (int i = 0; i < 3; ++i) write("image_0/00000" + std::to_string(i) + ".png", "no image");
  EXPECT_THAT(error(), AllOf(HasSubstr("image_0/000000.png"), HasSubstr("cannot be decoded as an image")));
}

}  // namespace
}  // namespace panvo::dataset_player

// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using KittiDataset = testing::WrittenDataset;

TEST_F(KittiDataset, IsRectifiedWithTheBaselineOfItsProjections) {
  write_kitti();
  const auto stereo = open_dataset(root_).stereo.value();
  EXPECT_DOUBLE_EQ(stereo.rectified.baseline_m, 0.2);
  EXPECT_DOUBLE_EQ(stereo.rectified.camera.fx, 50.0);
  EXPECT_TRUE(stereo.rectified.rectified_left_from_left.isIdentity());
  EXPECT_EQ(stereo.frames.size(), 3u);
  // base_link is at the left camera, x forward: the right camera is at negative y.
  EXPECT_TRUE(stereo.base_from_left.translation().isZero());
  EXPECT_TRUE(stereo.base_from_right().translation().isApprox(Eigen::Vector3d(0.0, -0.2, 0.0)));
  EXPECT_TRUE((stereo.base_from_left.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
}

TEST_F(KittiDataset, TakesItsTimesToTheNanosecond) {
  write_kitti();
  write("times.txt", "0.000000e+00\n1.037875e-01\n1317384506.400000001\n");
  const auto frames = open_dataset(root_).stereo->frames;
  EXPECT_EQ(frames[1].stamp_ns, 103'787'500);
  EXPECT_EQ(frames[2].stamp_ns, 1'317'384'506'400'000'001);
}

TEST_F(KittiDataset, IsPlayedAtTenHertzWhereItHasNoTimes) {
  write_kitti();
  const auto dataset = open_dataset(root_);
  EXPECT_EQ(dataset.stereo->frames[2].stamp_ns, 200'000'000);
  EXPECT_THAT(dataset.notes, ElementsAre(HasSubstr("10 Hz is assumed")));
  EXPECT_EQ(open_dataset(root_, {.rate_hz = 20.0}).stereo->frames[2].stamp_ns, 100'000'000);
}

TEST_F(KittiDataset, NamesTheLineOfATimeThatGoesBack) {
  write_kitti();
  write("times.txt", "0.0\n0.2\n0.1\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("times.txt:3:"), HasSubstr("must increase")));
}

TEST_F(KittiDataset, NamesTheLineOfATimeThatIsNoNumber) {
  write_kitti();
  write("times.txt", "0.0\nnan\n0.1\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("times.txt:2:"), HasSubstr("'nan'")));
}

TEST_F(KittiDataset, NamesTheLineOfATimeThatMessagesCannotHold) {
  write_kitti();
  write("times.txt", "0.0\n0.1\n2147483648\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("times.txt:3:"), HasSubstr("from 1970 to 2038")));
}

TEST_F(KittiDataset, NamesTheImageThatWouldBeLaterThanMessagesCanHold) {
  write_kitti();
  EXPECT_THROW(open_dataset(root_, {.rate_hz = 1e-12}), DatasetError);
  write_image("image_0/18000000000000000000.png");
  write_image("image_1/18000000000000000000.png");
  EXPECT_THAT(error(), AllOf(HasSubstr("image_0/18000000000000000000.png"), HasSubstr("later than stamps can be")));
}

TEST_F(KittiDataset, RefusesTimesThatEndBeforeTheImages) {
  write_kitti();
  write("times.txt", "0.0\n0.1\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("times.txt: has 2 times"), HasSubstr("000002.png")));
}

TEST_F(KittiDataset, TurnsItsPosesIntoTheAxesOfAVehicle) {
  write_kitti();
  // The second camera pose: 1 m forward (Z), 0.5 m to the right (X), turned to the right by 90 degrees (about Y,
  // which points down).
  write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 1 0.5 0 1 0 0 -1 0 0 1\n0 0 1 0.5 0 1 0 0 -1 0 0 1\n");
  const auto pose = open_dataset(root_).ground_truth.at(1).map_from_base;
  EXPECT_TRUE(pose.translation().isApprox(Eigen::Vector3d(1.0, -0.5, 0.0)));
  EXPECT_TRUE((pose.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY(), 1e-9));
}

TEST_F(KittiDataset, FindsItsPosesInTheFolderOfAllSequences) {
  const auto all = root_;
  root_ = all / "sequences" / "07";
  write_kitti();
  root_ = all;
  write("poses/07.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n");
  const auto dataset = open_dataset(all / "sequences" / "07" / "");
  EXPECT_EQ(dataset.ground_truth.size(), 2u);
  EXPECT_THAT(dataset.notes.back(), HasSubstr("the last 1 of 3 frames have no ground truth"));
}

TEST_F(KittiDataset, RefusesAPoseThatIsNoRotation) {
  write_kitti();
  write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n2 0 0 0 0 1 0 0 0 0 1 1\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("poses.txt:2:"), HasSubstr("not a rotation")));
}

TEST_F(KittiDataset, PlaysTheColourCamerasWhereThereIsNoGreyOne) {
  write("calib.txt",
        "P2: 50 0 32 3 0 50 24 0.2 0 0 1 0.003\n"
        "P3: 50 0 32 -22 0 50 24 2.2 0 0 1 0.003\n");
  for (const char* eye : {"image_2", "image_3"}) write_image(fs::path(eye) / "000000.png", kWidth, kHeight, 3);
  const auto stereo = open_dataset(root_).stereo.value();
  EXPECT_NEAR(stereo.rectified.baseline_m, 0.5, 1e-3);
  // Its left camera is about 6 cm to the left of camera 0, where base_link is.
  EXPECT_NEAR(stereo.base_from_left.translation().y(), 0.06, 3e-3);
}

TEST_F(KittiDataset, LeavesOutFramesThatLackAnEye) {
  write_kitti();
  fs::remove(root_ / "image_1" / "000001.png");
  const auto dataset = open_dataset(root_);
  ASSERT_EQ(dataset.stereo->frames.size(), 2u);
  EXPECT_EQ(dataset.stereo->frames[1].stamp_ns, 200'000'000) << "the gap must not move the frames after it";
  EXPECT_THAT(dataset.notes.front(), AllOf(HasSubstr("1 of 3 frames"), HasSubstr("image_0/000001.png")));
}

TEST_F(KittiDataset, RefusesToBeWithoutTheRightEye) {
  write_kitti();
  fs::remove_all(root_ / "image_1");
  EXPECT_THAT(error(), AllOf(HasSubstr("image_1: is missing"), HasSubstr("both cameras")));
}

TEST_F(KittiDataset, RefusesAnEmptyFolderOfImages) {
  write("calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\n");
  fs::create_directories(root_ / "image_0");
  EXPECT_THAT(error(), HasSubstr("image_0: contains no images"));
}

TEST_F(KittiDataset, RefusesAMissingCalibration) {
  write_kitti();
  fs::remove(root_ / "calib.txt");
  EXPECT_THAT(error(), HasSubstr("calib.txt: cannot be opened"));
}

TEST_F(KittiDataset, RefusesABaselineOfZero) {
  write_kitti();
  write("calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\nP1: 50 0 32 0 0 50 24 0 0 0 1 0\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("calib.txt"), HasSubstr("baseline is")));
}

TEST_F(KittiDataset, NamesTheLineOfACalibrationThatIsNotANumber) {
  write_kitti();
  write("calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\nP1: nan 0 32 -10 0 50 24 0 0 0 1 0\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("calib.txt:2:"), HasSubstr("not a finite number")));
}

TEST_F(KittiDataset, NamesTheLineOfACalibrationThatNoCameraHas) {
  write_kitti();
  write("calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\nP1: 1e300 0 32 -10 0 50 24 0 0 0 1 0\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("calib.txt:2:"), HasSubstr("1e300"), HasSubstr("plausible size")));
  write("calib.txt", "P0: 1e7 0 32 0 0 1e7 24 0 0 0 1 0\nP1: 1e7 0 32 -1e7 0 1e7 24 0 0 0 1 0\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("calib.txt"), HasSubstr("focal length")));
}

TEST_F(KittiDataset, RefusesACalibrationWhoseCamerasAreNowhere) {
  write_kitti();
  write("calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1e-9 1\nP1: 50 0 32 -10 0 50 24 0 0 0 1e-9 1\n");  // 1e9 m away
  EXPECT_THAT(error(), AllOf(HasSubstr("calib.txt"), HasSubstr("P0: places no camera")));
}

TEST_F(KittiDataset, NamesTheLineOfACalibrationThatWasCutOff) {
  write_kitti();
  write("calib.txt", "P0: 50 0 32 0 0 50 24 0 0 0 1 0\nP1: 50 0 32 -10 0\n");
  EXPECT_THAT(error(), AllOf(HasSubstr("calib.txt:2:"), HasSubstr("cut off")));
}

}  // namespace
}  // namespace panvo::dataset_player

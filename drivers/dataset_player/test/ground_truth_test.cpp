// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/ground_truth.hpp"

#include <gmock/gmock.h>

#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using GroundTruth = testing::WrittenDataset;

constexpr const char* kStill = "1 0 0 0 0 1 0 0 0 0 1 0\n";

TEST_F(GroundTruth, OfAMotionCaptureSystemIsFoundWhereThereIsNoState) {
  EXPECT_FALSE(find_ground_truth(root_));
  for (const char* folder : {"mocap0", "vicon0", "state_groundtruth_estimate0"}) {
    const auto file = fs::path("mav0") / folder / "data.csv";
    write(file, "1,0,0,0,1,0,0,0\n");
    EXPECT_EQ(find_ground_truth(root_), root_ / file) << "comes before those written earlier";
    EXPECT_EQ(find_ground_truth(root_ / "mav0"), root_ / file);
  }
}

TEST_F(GroundTruth, OfAMotionCaptureSystemIsPlayed) {
  write_euroc();
  write("mav0/mocap0/data.csv", "1000000000,1,2,3,1,0,0,0\n");
  EXPECT_EQ(open_dataset(root_).ground_truth.size(), 1u);
}

TEST_F(GroundTruth, OfKittiIsFoundInTheFolderOfAllSequencesOneOrTwoLevelsUp) {
  fs::create_directories(root_ / "sequences/03");
  write("poses/03.txt", kStill);
  EXPECT_EQ(find_ground_truth(root_ / "sequences/03"), root_ / "poses/03.txt");
  write("sequences/poses/03.txt", kStill);
  EXPECT_EQ(find_ground_truth(root_ / "sequences/03/"), root_ / "sequences/poses/03.txt");
  write("sequences/03/poses.txt", kStill);
  EXPECT_EQ(find_ground_truth(root_ / "sequences/03"), root_ / "sequences/03/poses.txt");
}

TEST_F(GroundTruth, OfKittiHasTheTimesOfItsSequence) {
  EXPECT_FALSE(find_kitti_times(root_ / "poses/03.txt"));
  write("sequences/03/times.txt", "0\n");
  EXPECT_EQ(find_kitti_times(root_ / "poses/03.txt"), root_ / "sequences/03/times.txt");
  write("03/times.txt", "0\n");
  EXPECT_EQ(find_kitti_times(root_ / "poses/03.txt"), root_ / "03/times.txt");
  EXPECT_EQ(find_kitti_times(root_ / "03/poses.txt"), root_ / "03/times.txt");
}

}  // namespace
}  // namespace panvo::dataset_player

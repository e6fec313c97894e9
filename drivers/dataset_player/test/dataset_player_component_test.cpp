// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/recorded_data.hpp"
#include "written_dataset.hpp"

namespace panvo::dataset_player {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class DatasetPlayer : public testing::WrittenDataset {
 protected:
  void play(std::map<std::string, std::string> parameters = {}) {
    parameters.emplace("directory", root_.string());
    harness_.load("panvo_dataset_player", "DatasetPlayerComponent", parameters);
    EXPECT_THAT(harness_.container().run(), IsEmpty());
  }

  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const sensor_msgs::msg::Image>>& left_ =
      harness_.collect(topics::kStereoLeftImageRaw);
  const std::vector<std::shared_ptr<const sensor_msgs::msg::Image>>& right_ =
      harness_.collect(topics::kStereoRightImageRaw);
  const std::vector<std::shared_ptr<const sensor_msgs::msg::CameraInfo>>& left_info_ =
      harness_.collect(topics::kStereoLeftCameraInfo);
  const std::vector<std::shared_ptr<const sensor_msgs::msg::CameraInfo>>& right_info_ =
      harness_.collect(topics::kStereoRightCameraInfo);
  const std::vector<std::shared_ptr<const sensor_msgs::msg::Image>>& panorama_ = harness_.collect(topics::kPanorama);
  const std::vector<std::shared_ptr<const tf2_msgs::msg::TFMessage>>& tf_ = harness_.collect(topics::kTfStatic);
  const std::vector<std::shared_ptr<const nav_msgs::msg::Odometry>>& ground_truth_ =
      harness_.collect(topics::kGroundTruth);
};

TEST_F(DatasetPlayer, PublishesWhatARobotWithTheseCamerasWould) {
  write_euroc(3);
  write("mav0/cam2/sensor.yaml", euroc_sensor(-0.2, 0.0, "equirectangular"));
  write("mav0/cam2/data.csv", "1000000000,1.png\n");
  write_image("mav0/cam2/data/1.png", kWidth, kHeight, 3);
  write("mav0/state_groundtruth_estimate0/data.csv", "1000000000,1,2,3,1,0,0,0\n1050000000,2,2,3,1,0,0,0\n");
  play();

  ASSERT_THAT(left_, SizeIs(3));
  ASSERT_THAT(right_, SizeIs(3));
  EXPECT_EQ(left_[1]->encoding(), "mono8");
  EXPECT_EQ(left_[1]->data()[77], 100);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto stamp_ns = 1'000'000'000 + static_cast<std::int64_t>(i) * 50'000'000;
    EXPECT_EQ(conversions::stamp_ns(*left_[i]), stamp_ns);
    EXPECT_EQ(conversions::stamp_ns(*right_[i]), stamp_ns);
    EXPECT_EQ(conversions::stamp_ns(*left_info_[i]), stamp_ns);
    EXPECT_EQ(conversions::stamp_ns(*right_info_[i]), stamp_ns);
  }
  const auto stereo =
      conversions::to_stereo(*conversions::to_camera(*left_info_[0]), *conversions::to_camera(*right_info_[0]));
  ASSERT_TRUE(stereo);
  EXPECT_NEAR(stereo->baseline_m, 0.2, 1e-9);

  ASSERT_THAT(tf_, SizeIs(1));
  conversions::TransformBuffer transforms;
  EXPECT_THAT(transforms.add_static(*tf_[0]), IsEmpty());
  EXPECT_TRUE(transforms.lookup("base_link", left_[0]->header().frame_id())
                  ->translation()
                  .isApprox(Eigen::Vector3d(2.0, 0.1, 1.5)));
  EXPECT_TRUE(transforms.lookup("base_link", right_[0]->header().frame_id())
                  ->translation()
                  .isApprox(Eigen::Vector3d(2.0, -0.1, 1.5)));

  ASSERT_THAT(panorama_, SizeIs(1));
  EXPECT_EQ(panorama_[0]->encoding(), "bgr8");
  EXPECT_TRUE(transforms.lookup("base_link", panorama_[0]->header().frame_id()));

  ASSERT_THAT(ground_truth_, SizeIs(2));
  EXPECT_EQ(ground_truth_[1]->header().frame_id(), "map");
  EXPECT_EQ(ground_truth_[1]->child_frame_id(), "base_link");
  EXPECT_TRUE(
      conversions::to_isometry(ground_truth_[1]->pose().pose())->translation().isApprox(Eigen::Vector3d(2, 2, 3)));
}

TEST_F(DatasetPlayer, HasReadWhatComesNextWhenItPublishes) {
  write_euroc(3);
  std::vector<std::string> files;
  for (const auto& file : std::filesystem::directory_iterator(root_ / "mav0/cam0/data")) files.push_back(file.path());
  std::ranges::sort(files);
  ASSERT_THAT(files, SizeIs(3));
  std::size_t seen = 0;
  runtime::ComponentDescription remover;
  remover.name = "remover";
  harness_.container().add(remover, [&](runtime::Context& context) {
    context.input(topics::kStereoLeftImageRaw, [&](const std::shared_ptr<const sensor_msgs::msg::Image>&) {
      if (++seen < files.size()) std::filesystem::remove(files[seen]);
    });
    return std::make_unique<runtime::Component>();
  });
  play();
  EXPECT_EQ(seen, 3u);
}

TEST_F(DatasetPlayer, DescribesARawPairAndWhatItRectifiesTo) {
  write_folders(2);
  play();
  ASSERT_THAT(left_, SizeIs(2));
  EXPECT_EQ(left_[0]->encoding(), "bgr8");
  EXPECT_EQ(conversions::stamp_ns(*left_[1]), 33'333'333);
  const auto camera = conversions::to_camera(*left_info_[0]);
  ASSERT_TRUE(camera);
  EXPECT_FALSE(conversions::is_rectified(*camera));
  EXPECT_DOUBLE_EQ(camera->raw.distortion[0], -0.1);
  EXPECT_TRUE(harness_.log_contains("30 Hz is assumed"));
}

TEST_F(DatasetPlayer, DecodesColourAsGreyIfAsked) {
  write_folders(2);
  play({{"grey", "true"}});
  ASSERT_THAT(left_, SizeIs(2));
  EXPECT_EQ(left_[0]->encoding(), "mono8");
  EXPECT_EQ(left_[0]->data().size(), static_cast<std::size_t>(kWidth * kHeight));
}

TEST_F(DatasetPlayer, LeavesOutAFrameThatCannotBeDecodedAndGoesOn) {
  write_euroc(4);
  write("mav0/cam1/data/1050000000.png", "no image");
  play();
  ASSERT_THAT(left_, SizeIs(3));
  EXPECT_THAT(right_, SizeIs(3));
  EXPECT_EQ(conversions::stamp_ns(*left_[1]), 1'100'000'000);
  EXPECT_TRUE(harness_.log_contains("cam1/data/1050000000.png: cannot be decoded as an image; frame skipped"));
  EXPECT_TRUE(harness_.log_contains("1 of 4 frames could not be read and were skipped"));
}

TEST_F(DatasetPlayer, LeavesOutAFrameOfAnotherSizeAndGoesOn) {
  write_euroc(3);
  write_image("mav0/cam0/data/1050000000.png", 32, 24);
  play();
  EXPECT_THAT(left_, SizeIs(2));
  EXPECT_TRUE(harness_.log_contains("cam0/data/1050000000.png: is 32 x 24 px, the previous images are 64 x 48 px"));
}

TEST_F(DatasetPlayer, BearsGreyAndColourImagesInOneRecording) {
  write_folders(3, 1);
  write_image("left/left2.jpg", kWidth, kHeight, 3);
  play();
  ASSERT_THAT(left_, SizeIs(3));
  EXPECT_EQ(left_[0]->encoding(), "mono8");
  EXPECT_EQ(left_[1]->encoding(), "bgr8");
  EXPECT_EQ(left_[2]->encoding(), "mono8");
}

TEST_F(DatasetPlayer, PlaysAPartIfAsked) {
  write_kitti(5);
  play({{"start_s", "0.1"}, {"duration_s", "0.2"}});
  ASSERT_THAT(left_, SizeIs(3));
  EXPECT_EQ(conversions::stamp_ns(*left_[0]), 100'000'000);
}

TEST_F(DatasetPlayer, RefusesADatasetThatIsNotThere) {
  root_ /= "nowhere";
  EXPECT_THROW(
      try { play(); } catch (const runtime::ConfigError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(root_.string()), HasSubstr("does not exist")));
        throw;
      },
      runtime::ConfigError);
}

TEST_F(DatasetPlayer, PlaysARealRecordingToItsEnd) {
  const auto path = panvo::test::recorded_data("kitti_03");
  PANVO_NEEDS_RECORDING(path);
  play({{"directory", path.string()}});
  EXPECT_THAT(left_, SizeIs(99));
  EXPECT_THAT(ground_truth_, SizeIs(99));
  EXPECT_EQ(left_[0]->width(), 1242u);
  EXPECT_TRUE(conversions::is_rectified(*conversions::to_camera(*right_info_[0])));
}

}  // namespace
}  // namespace panvo::dataset_player

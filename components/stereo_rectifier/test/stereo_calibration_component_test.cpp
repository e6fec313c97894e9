// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "panvo/calibration_files/stereo_pair.hpp"
#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/conversions/transform_buffer.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"
#include "panvo/test/temporary_folder.hpp"

namespace panvo::stereo_rectifier {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class StereoCalibration : public ::testing::Test {
 protected:
  StereoCalibration() {
    vision::StereoCalibration pair;
    pair.left =
        vision::lens_camera("plumb_bob", std::vector{-0.2, 0.05, 0.001, -0.002}, {400, 401, 320, 240, 640, 480});
    pair.right = vision::lens_camera("plumb_bob", std::vector{-0.21, 0.04, 0.0, 0.001}, {402, 402, 322, 238, 640, 480});
    pair.right_from_left.translation().x() = -0.25;
    const auto [left, right] = calibration_files::stereo_camera_infos(pair.left, pair.right, vision::rectify(pair));
    calibration_files::write_camera_info(folder_ / "left.yaml", left);
    calibration_files::write_camera_info(folder_ / "right.yaml", right);
  }

  void load(std::map<std::string, std::string> parameters = {}) {
    parameters.emplace("folder", folder_.path().string());
    harness_.load("panvo_stereo_rectifier", "StereoCalibrationComponent", parameters);
  }
  void publish_image(const interfaces::Topic<sensor_msgs::msg::Image>& topic, std::int64_t stamp_ns,
                     const std::string& frame) {
    std::shared_ptr<const sensor_msgs::msg::Image> image = conversions::make_image(stamp_ns, frame, "mono8", 640, 480);
    harness_.publish(topic, image);
  }

  test::TemporaryFolder folder_;
  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const sensor_msgs::msg::CameraInfo>>& left_ =
      harness_.collect(topics::kStereoLeftCameraInfo);
  const std::vector<std::shared_ptr<const sensor_msgs::msg::CameraInfo>>& right_ =
      harness_.collect(topics::kStereoRightCameraInfo);
  const std::vector<std::shared_ptr<const tf2_msgs::msg::TFMessage>>& transforms_ = harness_.collect(topics::kTfStatic);
};

TEST_F(StereoCalibration, GoesWithEachImageUnderItsStampAndFrame) {
  load();
  publish_image(topics::kStereoLeftImageRaw, 1'700'000'000'000'000'007, "cam0");
  publish_image(topics::kStereoRightImageRaw, 1'700'000'000'000'000'007, "cam1");
  ASSERT_THAT(left_, SizeIs(1));
  ASSERT_THAT(right_, SizeIs(1));
  EXPECT_EQ(conversions::stamp_ns(*left_[0]), 1'700'000'000'000'000'007);
  EXPECT_EQ(left_[0]->header().frame_id(), "cam0");
  EXPECT_EQ(right_[0]->header().frame_id(), "cam1");
  const auto left = conversions::to_camera(*left_[0]);
  const auto right = conversions::to_camera(*right_[0]);
  ASSERT_TRUE(left) << left.reason();
  ASSERT_TRUE(right) << right.reason();
  EXPECT_EQ(left->raw.pinhole.fx, 400.0);
  EXPECT_EQ(right->raw.distortion[0], -0.21);
  const auto pair = conversions::to_stereo(*left, *right);
  ASSERT_TRUE(pair) << pair.reason();
  EXPECT_NEAR(pair->baseline_m, 0.25, 1e-9);
  EXPECT_THAT(transforms_, IsEmpty());
}

TEST_F(StereoCalibration, TellsOnceWhereTheLeftCameraIsMounted) {
  load({{"mount", "[0.5, 0.1, 1.2, 90, 0, 0]"}});
  publish_image(topics::kStereoLeftImageRaw, 1, "cam0");
  publish_image(topics::kStereoLeftImageRaw, 2, "cam0");
  ASSERT_THAT(transforms_, SizeIs(1));
  conversions::TransformBuffer buffer;
  EXPECT_THAT(buffer.add_static(*transforms_[0]), IsEmpty());
  const auto base_from_camera = buffer.lookup("base_link", "cam0");
  ASSERT_TRUE(base_from_camera);
  EXPECT_TRUE(base_from_camera->translation().isApprox(Eigen::Vector3d(0.5, 0.1, 1.2), 1e-12));
  // turned to the left by 90 degrees: the optical axis is the vehicle's y axis
  EXPECT_TRUE((base_from_camera->linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST_F(StereoCalibration, TakesTheMountOfExtrinsicsYaml) {
  load({{"mount_xyz_rpy", "[0.5, 0.1, 1.2, 0, 0, 90]"}, {"panorama_mount_xyz_rpy", "[0, 0, 1.9, 90, 0, 0]"}});
  publish_image(topics::kStereoLeftImageRaw, 1, "cam0");
  publish_image(topics::kPanorama, 2, "pano");
  ASSERT_THAT(transforms_, SizeIs(2));
  conversions::TransformBuffer buffer;
  EXPECT_THAT(buffer.add_static(*transforms_[1]), IsEmpty());
  const Eigen::Isometry3d left = buffer.lookup("base_link", "cam0").value();
  EXPECT_TRUE((left.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-12))
      << "yaw: to the left";
  const Eigen::Isometry3d panorama = buffer.lookup("base_link", "pano").value();
  EXPECT_TRUE((panorama.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12))
      << "roll: the right of the image is below";
  EXPECT_FALSE(harness_.log_contains("obsolete"));
}

TEST_F(StereoCalibration, TellsHowItReadsAMountInTheOrderThatIsItsOwn) {
  load({{"mount", "[0, 0, 1.9, 3, 2, 1]"}});
  EXPECT_TRUE(harness_.log_contains("mount is obsolete: read as yaw 3, pitch 2, roll 1 degrees"));
}

TEST_F(StereoCalibration, RefusesTwoMountsOfOneCamera) {
  EXPECT_THROW(load({{"mount", "[0, 0, 0, 0, 0, 0]"}, {"mount_xyz_rpy", "[0, 0, 0, 0, 0, 0]"}}), runtime::ConfigError);
}

TEST_F(StereoCalibration, TellsWhereBothCamerasAreMounted) {
  load({{"mount", "[0.5, 0.1, 1.2, 0, 0, 0]"}, {"panorama_mount", "[0, 0, 1.9, 0, 0, 0]"}});
  publish_image(topics::kStereoLeftImageRaw, 1, "cam0");
  publish_image(topics::kPanorama, 2, "pano");
  ASSERT_THAT(transforms_, SizeIs(2));
  conversions::TransformBuffer buffer;
  EXPECT_THAT(buffer.add_static(*transforms_[1]), IsEmpty());  // a late reader gets only the last message
  ASSERT_TRUE(buffer.lookup("base_link", "cam0"));
  ASSERT_TRUE(buffer.lookup("base_link", "pano"));
  EXPECT_EQ(buffer.lookup("base_link", "pano")->translation().z(), 1.9);
}

TEST_F(StereoCalibration, WithoutFilesIsRefusedWithTheRemedy) {
  std::filesystem::remove(folder_ / "right.yaml");
  try {
    load();
    FAIL() << "was loaded";
  } catch (const runtime::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("right.yaml"));
    EXPECT_THAT(error.what(), HasSubstr("panvo calibrate convert"));
  }
}

TEST_F(StereoCalibration, MountNeedsSixNumbers) { EXPECT_THROW(load({{"mount", "[1, 2, 3]"}}), runtime::ConfigError); }

}  // namespace
}  // namespace panvo::stereo_rectifier

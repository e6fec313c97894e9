// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>

#include "panvo/conversions/camera_info.hpp"
#include "panvo/conversions/image.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/runtime/testing.hpp"

namespace panvo::stereo_rectifier {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kWidth = 64, kHeight = 48;

class StereoRectifier : public ::testing::Test {
 protected:
  StereoRectifier() {
    calibration_.left.pinhole = calibration_.right.pinhole = {50, 50, 32, 24, kWidth, kHeight};
    rectified_.camera = calibration_.left.pinhole;
    rectified_.baseline_m = 0.2;
  }

  void load(const std::map<std::string, std::string>& parameters = {}) {
    harness_.load("panvo_stereo_rectifier", "StereoRectifierComponent", parameters);
  }
  void publish_infos() {
    harness_.publish(topics::kStereoLeftCameraInfo,
                     conversions::to_camera_info(conversions::left_camera(calibration_, rectified_), 1, "left"));
    harness_.publish(topics::kStereoRightCameraInfo,
                     conversions::to_camera_info(conversions::right_camera(calibration_, rectified_), 1, "right"));
  }
  std::shared_ptr<const sensor_msgs::msg::Image> publish_left_image(std::int64_t stamp_ns = 1, int width = kWidth) {
    std::shared_ptr<const sensor_msgs::msg::Image> image =
        conversions::make_image(stamp_ns, "left", "mono8", width, kHeight);
    harness_.publish(topics::kStereoLeftImageRaw, image);
    return image;
  }
  std::size_t warnings() const {
    return static_cast<std::size_t>(std::count_if(harness_.log().begin(), harness_.log().end(),
                                                  [](const std::string& line) { return line.starts_with("warning"); }));
  }

  runtime::ComponentHarness harness_;
  const std::vector<std::shared_ptr<const sensor_msgs::msg::Image>>& left_rect_ =
      harness_.collect(topics::kStereoLeftImageRect);
  const std::vector<std::shared_ptr<const sensor_msgs::msg::Image>>& right_rect_ =
      harness_.collect(topics::kStereoRightImageRect);
  vision::StereoCalibration calibration_;
  vision::RectifiedStereo rectified_;
};

TEST_F(StereoRectifier, HandsOnARectifiedImageWithoutCopyingAPixel) {
  load();
  publish_infos();
  const auto raw = publish_left_image();
  ASSERT_THAT(left_rect_, SizeIs(1));
  EXPECT_EQ(left_rect_[0]->data().data(), raw->data().data());
  EXPECT_EQ(warnings(), 0u);
}

TEST_F(StereoRectifier, RectifiesARawImageUnderItsStamp) {
  calibration_.left.distortion[0] = -0.2;
  calibration_.right.distortion[0] = -0.2;
  calibration_.right_from_left.translation().x() = -0.2;
  rectified_ = vision::rectify(calibration_);
  load();
  publish_infos();
  const auto raw = publish_left_image(1'700'000'000'000'000'007);
  ASSERT_THAT(left_rect_, SizeIs(1));
  EXPECT_NE(left_rect_[0]->data().data(), raw->data().data());
  EXPECT_EQ(conversions::stamp_ns(*left_rect_[0]), 1'700'000'000'000'000'007);
}

TEST_F(StereoRectifier, MissesACameraInfoThatDoesNotCome) {
  load();
  for (int i = 0; i < 20; ++i) publish_left_image(i);
  EXPECT_THAT(left_rect_, IsEmpty());
  EXPECT_EQ(warnings(), 1u);
  EXPECT_TRUE(harness_.log_contains("nothing on /stereo/left/camera_info"));
}

TEST_F(StereoRectifier, RefusesAnUncalibratedCameraOnce) {
  load();
  harness_.publish(topics::kStereoLeftCameraInfo, sensor_msgs::msg::CameraInfo());
  publish_left_image(1);
  publish_left_image(2);
  EXPECT_THAT(left_rect_, IsEmpty());
  EXPECT_EQ(warnings(), 1u);
  EXPECT_TRUE(harness_.log_contains("stereo/left/image_raw has a camera_info that is not calibrated"));
}

TEST_F(StereoRectifier, RefusesCamerasThatAreNoPair) {
  rectified_.baseline_m = 0.0;
  load();
  publish_infos();
  publish_left_image();
  EXPECT_THAT(left_rect_, IsEmpty());
  EXPECT_TRUE(
      harness_.log_contains("/stereo/left/camera_info and /stereo/right/camera_info do not form a stereo pair"));
}

TEST_F(StereoRectifier, RefusesImagesOfAnotherSizeAndGoesOnAfter) {
  load();
  publish_infos();
  publish_left_image(1, 32);
  EXPECT_THAT(left_rect_, IsEmpty());
  EXPECT_TRUE(harness_.log_contains("stereo/left/image_raw is 32 x 48 px, but its camera_info is for 64 x 48 px"));
  publish_left_image(2);
  EXPECT_THAT(left_rect_, SizeIs(1));
}

TEST_F(StereoRectifier, SaysThatACameraChanged) {
  load();
  publish_infos();
  publish_left_image(1);
  calibration_.left.pinhole.cx += 1.0;
  publish_infos();
  for (int i = 2; i < 6; ++i) publish_left_image(i);
  EXPECT_FALSE(harness_.log_contains("changed while running"));
  publish_left_image(6);
  EXPECT_TRUE(harness_.log_contains("stereo/left/camera_info changed while running"));
  EXPECT_THAT(left_rect_, SizeIs(6));
  EXPECT_THAT(right_rect_, IsEmpty());
}

TEST_F(StereoRectifier, TakesTheCameraOfImagesOfAnotherSizeAtOnce) {
  load();
  publish_infos();
  publish_left_image(1);
  calibration_.left.pinhole = calibration_.right.pinhole = rectified_.camera = {25, 25, 16, 24, kWidth / 2, kHeight};
  publish_infos();
  publish_left_image(2, kWidth / 2);
  EXPECT_THAT(left_rect_, SizeIs(2));
}

TEST_F(StereoRectifier, KeepsTheCalibrationIfTwoPublishersDisagree) {
  load();
  const auto first = calibration_;
  auto other = calibration_;
  other.left.distortion[0] = -0.2;
  for (int i = 0; i < 20; ++i) {
    calibration_ = i % 2 == 0 ? first : other;
    publish_infos();
    const auto raw = publish_left_image(i);
    ASSERT_THAT(left_rect_, SizeIs(i + 1));
    EXPECT_EQ(left_rect_.back().get(), raw.get()) << "another image, rectified by the other calibration";
  }
  EXPECT_TRUE(
      harness_.log_contains("/stereo/left/camera_info alternates between two calibrations: two publishers disagree"));
  EXPECT_EQ(warnings(), 1u);
}

TEST_F(StereoRectifier, LeavesACalibrationThatIsNoneAtOnce) {
  load();
  publish_infos();
  harness_.publish(topics::kStereoLeftCameraInfo, sensor_msgs::msg::CameraInfo());
  publish_left_image(1);
  EXPECT_THAT(left_rect_, IsEmpty());
  publish_infos();
  publish_left_image(2);
  EXPECT_THAT(left_rect_, SizeIs(1));
}

TEST_F(StereoRectifier, KnowsItsParameters) {
  try {
    load({{"output", "gray"}});
    FAIL() << "accepted";
  } catch (const runtime::ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("output"), HasSubstr("mono8"), HasSubstr("same")));
  }
}

}  // namespace
}  // namespace panvo::stereo_rectifier

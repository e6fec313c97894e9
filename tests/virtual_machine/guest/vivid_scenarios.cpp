// SPDX-License-Identifier: Apache-2.0
// The driver on two simulated cameras of the kernel (vivid), with known images and faults on command.
#include <unistd.h>

#include "grabbed.hpp"
#include "panvo/v4l2_camera/device_list.hpp"

namespace panvo::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using v4l2_camera::CameraSettings;
using v4l2_camera::ImageParts;

constexpr const char* kFirst = "/dev/video0";
constexpr const char* kSecond = "/dev/video1";

/// Small images of one colour or of bars, without vivid's clock overlay.
CameraSettings vivid(const std::string& pixel_format, const std::string& pattern = "75% Colorbar",
                     ImageParts parts = ImageParts::kOne) {
  auto settings = camera(kFirst, parts);
  settings.format = {pixel_format, 320, 180, 30.0};
  settings.controls = {{"brightness", "128"}, {"osd_text_mode", "2"}, {"test_pattern", pattern}};
  return settings;
}

/// On an emulated processor, the simulated camera keeps its average rate but skips frames when it has no time. These
/// gaps in its stamps must be counted as dropped.
void expect_all_counted(const std::vector<Grabbed::Frame>& frames, const camera_stream::StreamCounters& counters) {
  const double seconds = static_cast<double>(frames.back().stamp_ns - frames.front().stamp_ns) * 1e-9;
  const auto counted = static_cast<double>(frames.size() - 1 + counters.dropped);
  constexpr double kComeInBetween = 5.0;  // frames that arrive between both queries
  EXPECT_NEAR(counted, seconds * 30.0, kComeInBetween) << counters.dropped << " dropped";
}

class VividCamera : public ::testing::TestWithParam<const char*> {};

class VividColour : public VividCamera {};
TEST_P(VividColour, IsRed) {
  const Grabbed grabbed(vivid(GetParam(), "100% Red"));
  ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
  EXPECT_EQ(grabbed.counters().refused_settings, 0u) << grabbed.log();
  const auto image = grabbed.frames().back().images.at(0);
  ASSERT_EQ(image->width(), 320u);
  ASSERT_EQ(image->height(), 180u);
  auto colour = mean_of(*image, 0.1, 0.9);
  ASSERT_EQ(colour.size(), 3u) << image->encoding();
  if (image->encoding() == "rgb8") std::swap(colour[0], colour[2]);
  EXPECT_NEAR(colour[0], 0.0, 6.0);
  EXPECT_NEAR(colour[1], 0.0, 6.0);
  EXPECT_NEAR(colour[2], 255.0, 6.0);
}
INSTANTIATE_TEST_SUITE_P(OfFormat, VividColour,
                         ::testing::Values("YUYV", "UYVY", "RGB3", "BGR3", "RGGB", "GRBG", "GBRG", "BA81"));

class VividGrey : public VividCamera {};
TEST_P(VividGrey, IsWhiteAndBlack) {
  for (const auto& [pattern, level] : {std::pair{"100% White", 255.0}, std::pair{"100% Black", 0.0}}) {
    auto settings = vivid(GetParam(), pattern);
    settings.output = camera_stream::ImageOutput::kGrey;
    const Grabbed grabbed(settings);
    ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
    EXPECT_EQ(grabbed.counters().refused_settings, 0u) << grabbed.log();
    const auto image = grabbed.frames().back().images.at(0);
    ASSERT_EQ(image->encoding(), "mono8");
    EXPECT_NEAR(mean_of(*image, 0.1, 0.9).at(0), level, 3.0) << pattern;
  }
}
INSTANTIATE_TEST_SUITE_P(OfFormat, VividGrey, ::testing::Values("GREY", "Y10", "Y12", "Y16"));

TEST_F(VividCamera, ShowsTheBarsOfItsLeftAndRightHalfToTheEyes) {
  const Grabbed grabbed(vivid("RGB3", "75% Colorbar", ImageParts::kSideBySide));
  ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
  const auto images = grabbed.frames().back().images;
  ASSERT_EQ(images.size(), 2u);
  ASSERT_EQ(images[1]->width(), 160u);
  // White, yellow, cyan, green | magenta, red, blue, black, each at 75 %.
  const auto is_rgb = [](const std::vector<double>& colour, double red, double green, double blue) {
    for (const auto& [value, expected] : {std::pair{colour[0], red}, {colour[1], green}, {colour[2], blue}})
      EXPECT_NEAR(value, 191.0 * expected, 4.0);
  };
  is_rgb(mean_of(*images[0], 0.05, 0.2), 1, 1, 1);
  is_rgb(mean_of(*images[0], 0.8, 0.95), 0, 1, 0);
  is_rgb(mean_of(*images[1], 0.05, 0.2), 1, 0, 1);
  is_rgb(mean_of(*images[1], 0.55, 0.7), 0, 0, 1);
}

TEST_F(VividCamera, DeliversAllFramesWithTheKernelsStamps) {
  const Grabbed grabbed(vivid("GREY"));
  ASSERT_TRUE(grabbed.more_come(60)) << grabbed.log();
  const auto frames = grabbed.frames();
  for (std::size_t i = 1; i < frames.size(); ++i) ASSERT_GT(frames[i].stamp_ns, frames[i - 1].stamp_ns);
  const auto report = grabbed.report();
  expect_all_counted(frames, report.counters);
  EXPECT_EQ(report.counters.clock_resets, 0u);
  EXPECT_EQ(report.details.at("stamps"), "end of frame");
}

TEST_F(VividCamera, SaysWhatItGivesInsteadOfWhatWasAskedFor) {
  auto settings = vivid("MJPG");
  settings.format.width = 1000;
  settings.format.height = 481;
  settings.controls.push_back({"brightness", "300"});
  settings.controls.push_back({"no_such_thing", "1"});
  const Grabbed grabbed(settings);
  ASSERT_TRUE(grabbed.more_come(1)) << grabbed.log();
  EXPECT_THAT(grabbed.log(), HasSubstr("format MJPG 1000 x 481 px: the camera gives YUYV 640 x 480 px"));
  EXPECT_THAT(grabbed.log(), HasSubstr("brightness=300: is out of range, 0 to 255"));
  EXPECT_THAT(grabbed.log(), HasSubstr("no_such_thing=1: the camera has no control of that name; it has"));
  EXPECT_THAT(grabbed.log(), HasSubstr("frame_rate_hz 30: the camera gives 25 Hz"));
  EXPECT_EQ(grabbed.counters().refused_settings, 4u);
}

TEST_F(VividCamera, RefusesCompressedVideoAndSelectorsThatFitNone) {
  const Grabbed h264(vivid("H264"));
  EXPECT_TRUE(soon([&] { return h264.log_contains("H264 is compressed video"); })) << h264.log();
  const Grabbed nobody(camera("SERIAL"));
  EXPECT_TRUE(soon([&] { return nobody.log_contains("camera 'SERIAL' not found; available: no serial (vivid-000"); }))
      << nobody.log();
  EXPECT_EQ(h264.count() + nobody.count(), 0u);
}

TEST_F(VividCamera, IsToldToBeInUseAndTakenWhenItIsFree) {
  auto first = std::make_unique<Grabbed>(vivid("GREY"));
  ASSERT_TRUE(first->more_come(1)) << first->log();
  const Grabbed second(vivid("GREY"));
  EXPECT_TRUE(soon([&] { return second.log_contains("/dev/video0 is in use by another program"); })) << second.log();
  EXPECT_TRUE(first->more_come(10)) << "the first user is not disturbed";
  EXPECT_EQ(second.count(), 0u);
  first.reset();
  EXPECT_TRUE(second.more_come(3)) << second.log();
}

TEST_F(VividCamera, IsForbiddenToOtherUsersWithTheRemedy) {
  ASSERT_EQ(seteuid(65534), 0);
  std::string what;
  try {
    v4l2_camera::open_video_device(kFirst);
  } catch (const v4l2_camera::DeviceError& error) {
    what = error.what();
    EXPECT_EQ(error.kind(), v4l2_camera::DeviceError::Kind::kNotAllowed);
  }
  ASSERT_EQ(seteuid(0), 0);
  EXPECT_THAT(what, HasSubstr("usermod -aG video"));
}

TEST_F(VividCamera, CountsFramesThatItDrops) {
  auto settings = vivid("GREY");
  settings.controls.push_back({"percentage_of_dropped_buffers", "20"});
  const Grabbed grabbed(settings);
  ASSERT_TRUE(grabbed.more_come(60)) << grabbed.log();
  const auto frames = grabbed.frames();
  const auto counters = grabbed.counters();
  EXPECT_GE(counters.dropped, 5u) << "a fifth of about 75 frames";
  expect_all_counted(frames, counters);
  set_control(kFirst, "percentage_of_dropped_buffers", 0);
}

TEST_F(VividCamera, CountsAFrameThatItMarksAsDamaged) {
  const Grabbed grabbed(vivid("GREY"));
  ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
  set_control(kFirst, "inject_v4l2_buf_flag_error", 1);
  ASSERT_TRUE(soon([&] { return grabbed.counters().damaged == 1; })) << grabbed.log();
  ASSERT_TRUE(grabbed.more_come(3));
  EXPECT_EQ(grabbed.counters().damaged, 1u);
  EXPECT_EQ(grabbed.counters().reconnects, 0u);
}

TEST_F(VividCamera, IsTriedAgainWhenItDoesNotStream) {
  set_control(kFirst, "inject_vidioc_streamon_error", 1);
  const Grabbed grabbed(vivid("GREY"));
  ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
  EXPECT_EQ(grabbed.counters().failed_opens, 1u);
}

TEST_F(VividCamera, IsOpenedAnewAfterAFatalErrorWithItsSettings) {
  auto settings = vivid("GREY");
  settings.controls.push_back({"brightness", "77"});
  const Grabbed grabbed(settings);
  ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
  set_control(kFirst, "brightness", 10);
  set_control(kFirst, "inject_fatal_streaming_error", 1);
  ASSERT_TRUE(soon([&] { return grabbed.counters().reconnects == 1; })) << grabbed.log();
  ASSERT_TRUE(grabbed.more_come(3));
  const auto device = v4l2_camera::open_video_device(kFirst);
  for (const auto& control : device->controls()) {
    if (control.name == "brightness") {
      EXPECT_EQ(device->control(control), 77);
    }
  }
}

TEST_F(VividCamera, IsListedWithWhatItCanDo) {
  const Grabbed grabbed(vivid("GREY"));
  ASSERT_TRUE(grabbed.more_come(1));
  const auto found = v4l2_camera::find_devices();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].model, "vivid-000-vid-cap");
  EXPECT_THAT(found[1].formats,
              AllOf(Contains("YUYV"), Contains("GREY"), Contains("RGGB"), Contains(HasSubstr("not supported"))));
  EXPECT_THAT(found[1].sizes, HasSubstr("320 x 180, 640 x 360"));
  EXPECT_EQ(found[1].address, kSecond);
  EXPECT_TRUE(grabbed.more_come(3)) << "streaming continues during the listing";
}

TEST_F(VividCamera, ComesBackEachTimeItWasAway) {
  const Grabbed grabbed(vivid("GREY"));
  constexpr std::uint64_t kTimes = 20;
  for (std::uint64_t time = 1; time <= kTimes; ++time) {
    ASSERT_TRUE(grabbed.more_come(2)) << grabbed.log();
    set_control(kFirst, "disconnect", 1);  // until the last process that has it open closes it
    ASSERT_TRUE(soon([&] { return grabbed.counters().reconnects == time; })) << time << "\n" << grabbed.log();
  }
  EXPECT_TRUE(grabbed.log_contains("/dev/video0 does not exist or was disconnected")) << grabbed.log();
  const auto frames = grabbed.frames();
  for (std::size_t i = 1; i < frames.size(); ++i) ASSERT_GT(frames[i].stamp_ns, frames[i - 1].stamp_ns);
}

}  // namespace
}  // namespace panvo::test

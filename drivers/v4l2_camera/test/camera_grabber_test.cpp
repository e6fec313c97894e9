// SPDX-License-Identifier: Apache-2.0
#include "panvo/v4l2_camera/camera_grabber.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "fake_device.hpp"
#include "panvo/v4l2_camera/device_list.hpp"

namespace panvo::v4l2_camera::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const VideoNode kNode{"/dev/video0", "Cam", "S1", "M", "1-1", 0};

/// A grabber with a fake camera; collects frames and log.
class GrabbedCamera : public ::testing::Test {
 protected:
  void grab(CameraSettings settings = {}) {
    if (settings.name.empty()) settings.name = "camera";
    if (settings.frame_ids.empty()) settings.frame_ids = {"camera_optical"};
    grabber_ = std::make_unique<CameraGrabber>(
        std::move(settings), log_,
        [this](CameraGrabber::Frame frame) {
          const std::lock_guard lock(mutex_);
          frames_.push_back(std::move(frame));
        },
        usb_.devices());
  }
  void TearDown() override { grabber_.reset(); }

  [[nodiscard]] static bool eventually(const std::function<bool()>& condition) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > give_up) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  bool is_streaming() const { return grabber_->report().is_streaming; }
  std::size_t frames() {
    const std::lock_guard lock(mutex_);
    return frames_.size();
  }
  std::vector<std::int64_t> stamps() {
    const std::lock_guard lock(mutex_);
    std::vector<std::int64_t> stamps;
    for (const auto& frame : frames_) stamps.push_back(frame.stamp_ns);
    return stamps;
  }
  std::string log() {
    const std::lock_guard lock(mutex_);
    return text_;
  }
  bool sends_and_comes(const std::string& path, std::uint32_t number) {
    const auto before = frames();
    usb_.send(path, number, std::vector<std::uint8_t>(8, 1));
    return eventually([&] { return frames() == before + 1; });
  }

  FakeUsb usb_;
  std::mutex mutex_;
  std::vector<CameraGrabber::Frame> frames_;
  std::string text_;
  runtime::Logger log_{"test", [this](runtime::LogLevel, const std::string&, const std::string& text) {
                         const std::lock_guard lock(mutex_);
                         text_ += text + "\n";
                       }};
  std::unique_ptr<CameraGrabber> grabber_;
};

TEST_F(GrabbedCamera, DeliversItsFramesAndGivesTheBuffersBack) {
  const auto camera = usb_.plug_in(kNode);
  grab();
  ASSERT_TRUE(eventually([&] { return is_streaming(); })) << log();
  usb_.send(kNode.path, 0, {1, 2, 3, 4, 5, 6, 7, 8});
  ASSERT_TRUE(eventually([&] { return frames() == 1; }));
  {
    const std::lock_guard lock(mutex_);
    ASSERT_EQ(frames_[0].images.size(), 1u);
    EXPECT_EQ(frames_[0].images[0]->encoding(), "mono8");
    EXPECT_THAT(frames_[0].images[0]->data(), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
    EXPECT_EQ(frames_[0].images[0]->header().frame_id(), "camera_optical");
  }
  EXPECT_EQ(usb_.with([&](auto&) { return camera->given_back; }), 1);
  const auto report = grabber_->report();
  EXPECT_EQ(report.serial, "S1");
  EXPECT_EQ(report.counters.frames, 1u);
  EXPECT_EQ(report.details.at("given"), "GREY 4 x 2 px, 30 Hz");
}

TEST_F(GrabbedCamera, DeliversBothEyesOfOneImage) {
  usb_.plug_in(kNode);
  CameraSettings settings;
  settings.parts.parts = ImageParts::kSideBySide;
  settings.frame_ids = {"left", "right"};
  grab(settings);
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  usb_.send(kNode.path, 0, {1, 2, 3, 4, 5, 6, 7, 8});
  ASSERT_TRUE(eventually([&] { return frames() == 1; }));
  const std::lock_guard lock(mutex_);
  ASSERT_EQ(frames_[0].images.size(), 2u);
  EXPECT_THAT(frames_[0].images[0]->data(), ElementsAre(1, 2, 5, 6));
  EXPECT_THAT(frames_[0].images[1]->data(), ElementsAre(3, 4, 7, 8));
  EXPECT_EQ(frames_[0].images[1]->header().frame_id(), "right");
}

TEST_F(GrabbedCamera, CountsWhatWasDroppedDamagedAndIncomplete) {
  usb_.plug_in(kNode);
  grab();
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  const std::vector<std::uint8_t> whole(8, 1);
  usb_.send(kNode.path, 0, whole);
  usb_.send(kNode.path, 3, whole);  // 1 and 2 are missing
  usb_.send(kNode.path, 4, whole, true);
  usb_.send(kNode.path, 5, {1, 2, 3});
  usb_.send(kNode.path, 6, {});
  usb_.send(kNode.path, 7, whole);
  ASSERT_TRUE(eventually([&] { return frames() == 3; }));
  const auto counters = grabber_->report().counters;
  EXPECT_EQ(counters.frames, 3u);
  EXPECT_EQ(counters.dropped, 2u);
  EXPECT_EQ(counters.damaged, 1u);
  EXPECT_EQ(counters.incomplete, 2u);
  EXPECT_THAT(log(), HasSubstr("is marked as damaged"));
  EXPECT_THAT(log(), HasSubstr("holds 3 bytes where GREY 4 x 2 px need 8"));
}

TEST_F(GrabbedCamera, ComesBackByItsSerialNumberWithItsControls) {
  usb_.plug_in(kNode);
  CameraSettings settings;
  settings.controls = {{"gain", "42"}};
  grab(settings);
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  ASSERT_TRUE(sends_and_comes(kNode.path, 0));
  constexpr int kTimes = 20;
  std::string path = kNode.path;
  for (int time = 1; time <= kTimes; ++time) {
    usb_.unplug(path);
    ASSERT_TRUE(eventually([&] { return !is_streaming(); }));
    VideoNode node = kNode;  // another node each time; the old node goes to another camera
    node.path = path = "/dev/video" + std::to_string(time);
    VideoNode other = kNode;
    other.serial = "S2";
    usb_.plug_in(other);
    const auto camera = usb_.plug_in(node);
    ASSERT_TRUE(eventually([&] { return is_streaming(); })) << time << log();
    EXPECT_EQ(usb_.with([&](auto&) { return camera->values["gain"]; }), 42) << time;
    ASSERT_TRUE(sends_and_comes(path, static_cast<std::uint32_t>(500 * time))) << time;
    EXPECT_EQ(grabber_->report().counters.reconnects, static_cast<std::uint64_t>(time));
    EXPECT_EQ(grabber_->report().serial, "S1");
  }
  EXPECT_EQ(grabber_->report().counters.dropped, 0u) << "numbering restarts with each stream";
  const auto all = stamps();
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GT(all[i], all[i - 1]);
}

TEST_F(GrabbedCamera, IsOpenedAnewWhenItSendsNothing) {
  const auto camera = usb_.plug_in(kNode);
  CameraSettings settings;
  settings.watchdog_ns = 50'000'000;
  grab(settings);
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  ASSERT_TRUE(sends_and_comes(kNode.path, 0));
  ASSERT_TRUE(eventually([&] { return usb_.with([&](auto&) { return camera->starts; }) >= 2; })) << log();
  EXPECT_THAT(log(), HasSubstr("sent no frame in time"));
  // Send until a frame arrives between two watchdog timeouts.
  ASSERT_TRUE(eventually([&] {
    usb_.send(kNode.path, 1, std::vector<std::uint8_t>(8, 1));
    return grabber_->report().counters.reconnects >= 1;
  }));
}

TEST_F(GrabbedCamera, IsNotAwaitedAsLongAsAnEarlierSlowerOne) {
  const auto first = usb_.plug_in(kNode);
  usb_.with([&](auto&) { first->rate_hz = 0.001; });  // an image in a quarter of an hour
  CameraSettings settings;
  settings.watchdog_ns = 50'000'000;
  grab(settings);
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  usb_.unplug(kNode.path);
  ASSERT_TRUE(eventually([&] { return !is_streaming(); }));
  const auto again = usb_.plug_in(kNode);
  usb_.with([&](auto&) { again->rate_hz = 0.0; });
  EXPECT_TRUE(eventually([&] { return usb_.with([&](auto&) { return again->starts; }) >= 2; })) << log();
}

TEST_F(GrabbedCamera, IsToldToBeInUseAndTakenWhenItIsFree) {
  const auto camera = usb_.plug_in(kNode);
  usb_.with([&](auto&) { camera->open_error = DeviceError(DeviceError::Kind::kBusy, "is in use"); });
  grab();
  ASSERT_TRUE(eventually([&] { return log().find("is in use") != std::string::npos; }));
  EXPECT_FALSE(is_streaming());
  EXPECT_EQ(grabber_->report().state, "not connected: is in use");
  usb_.with([&](auto&) { camera->open_error.reset(); });
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  EXPECT_GE(grabber_->report().counters.failed_opens, 2u) << "logged at the second failure";
}

TEST_F(GrabbedCamera, IsToldNotToStreamAndTriedAgain) {
  const auto camera = usb_.plug_in(kNode);
  usb_.with([&](auto&) { camera->start_error = DeviceError(DeviceError::Kind::kOther, "VIDIOC_STREAMON fails"); });
  grab();
  ASSERT_TRUE(eventually([&] { return log().find("VIDIOC_STREAMON fails") != std::string::npos; }));
  EXPECT_FALSE(is_streaming());
  usb_.with([&](auto&) { camera->start_error.reset(); });
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  EXPECT_GE(usb_.with([&](auto&) { return camera->opened; }), 3) << "closed after each failure";
}

TEST_F(GrabbedCamera, IsAwaited) {
  CameraSettings settings;
  settings.camera = "S1";
  grab(settings);
  VideoNode other = kNode;
  other.serial = "S2";
  usb_.plug_in(other);
  ASSERT_TRUE(eventually([&] { return log().find("camera 'S1' not found; available: S2") != std::string::npos; }))
      << log();
  VideoNode wanted = kNode;
  wanted.path = "/dev/video2";
  usb_.plug_in(wanted);
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  EXPECT_EQ(grabber_->report().serial, "S1");
}

TEST_F(GrabbedCamera, IsSetWhileItStreamsAndSaysWhatItRefuses) {
  const auto camera = usb_.plug_in(kNode);
  CameraSettings settings;
  settings.controls = {{"gain", "11"}};
  settings.format.pixel_format = "YUYV";
  grab(settings);
  ASSERT_TRUE(eventually([&] { return is_streaming(); }));
  EXPECT_THAT(log(), HasSubstr("format YUYV 4 x 2 px: the camera gives GREY 4 x 2 px"));
  EXPECT_EQ(grabber_->report().counters.refused_settings, 1u);
  grabber_->set({{"gain", "12"}, {"brightness", "101"}, {"zoom", "1"}});
  ASSERT_TRUE(eventually([&] { return grabber_->report().counters.refused_settings == 2; })) << log();
  EXPECT_EQ(usb_.with([&](auto&) { return camera->values["gain"]; }), 12);
  EXPECT_THAT(log(), HasSubstr("controls: brightness=101: is out of range, 0 to 100"));
  EXPECT_THAT(log(), HasSubstr("controls: zoom=1: the camera has no control of that name; it has brightness, gain"));
}

TEST(DeviceList, TellsFormatsSizesRatesAndWhatCannotBeOpened) {
  FakeUsb usb;
  const auto camera = usb.plug_in(kNode);
  camera->formats.push_back(
      {pixel_code('H', '2', '6', '4'), "H.264", {{.width = 4, .height = 2, .rates_hz = {60.0, 5.0}}}});
  VideoNode busy = kNode;
  busy.path = "/dev/video1";
  busy.serial = "S2";
  usb.plug_in(busy)->open_error = DeviceError(DeviceError::Kind::kNotAllowed, "may not be opened");
  VideoNode metadata = kNode;
  metadata.path = "/dev/video2";
  metadata.index = 1;
  usb.plug_in(metadata)->open_error = DeviceError(DeviceError::Kind::kOther, "is not a camera");
  const auto found = find_devices(usb.devices());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].serial, "S1");
  EXPECT_THAT(found[0].formats, ElementsAre("GREY", "H264 (not supported)"));
  EXPECT_EQ(found[0].sizes, "4 x 2 px");
  EXPECT_EQ(found[0].rates, "5 to 60 Hz");
  EXPECT_EQ(found[0].address, "/dev/video0, USB port 1-1");
  EXPECT_EQ(found[1].problem, "may not be opened");
}

}  // namespace
}  // namespace panvo::v4l2_camera::testing

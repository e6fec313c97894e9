// SPDX-License-Identifier: Apache-2.0
// The driver on USB cameras simulated in user space, through the kernel's uvcvideo: plugged in, configured, damaged,
// unplugged.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "grabbed.hpp"
#include "numbered_pictures.hpp"
#include "panvo/v4l2_camera/device_list.hpp"
#include "usb_camera.hpp"

namespace panvo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using v4l2_camera::CameraSettings;
using v4l2_camera::ImageParts;
using Steady = std::chrono::steady_clock;

class UsbStereoCamera : public ::testing::Test {
 protected:
  static constexpr int kWidth = 640, kHeight = 240;

  UsbStereoCamera() { plug_in(); }

  /// Waits until the node of the camera has disappeared, so that the next test does not find it.
  ~UsbStereoCamera() override {
    unplug();
    EXPECT_TRUE(soon([] { return v4l2_camera::find_devices().empty(); }));
  }

  void plug_in(UsbCamera::Picture picture = {}) {
    if (!picture) picture = [this](std::uint32_t number) { return pictures().file(number); };
    camera_ = std::make_unique<UsbCamera>(0, CameraModel{.serial = "SBS001", .width = kWidth, .height = kHeight},
                                          std::move(picture));
  }
  void unplug() { camera_.reset(); }

  static CameraSettings settings() {
    auto settings = camera("SBS001", ImageParts::kSideBySide);
    settings.format = {"MJPG", kWidth, kHeight, 30.0};
    settings.output = camera_stream::ImageOutput::kGrey;
    settings.controls = {{"gain", "42"}};
    return settings;
  }

  static const NumberedPictures& pictures() {
    static const NumberedPictures pictures(kWidth, kHeight);
    return pictures;
  }

  std::vector<std::int64_t> began_ns_;  // used by the camera's thread until it is unplugged
  std::unique_ptr<UsbCamera> camera_;
};

/// Numbers of the images since the camera was plugged in, unwrapped; empty if an image has no number or is from the
/// wrong eye.
std::vector<std::uint32_t> numbers(const std::vector<Grabbed::Frame>& frames) {
  std::vector<std::uint32_t> numbers;
  std::uint32_t next = 0;
  for (const auto& frame : frames) {
    const auto left = read_number(*frame.images.at(0)), right = read_number(*frame.images.at(1));
    if (!left || !right || left->is_right || !right->is_right || left->number != right->number) return {};
    const std::uint32_t skipped = (left->number + NumberedPictures::kCount - next % NumberedPictures::kCount);
    numbers.push_back(next + skipped % NumberedPictures::kCount);
    next = numbers.back() + 1;
  }
  return numbers;
}

/// Number of images between the first and the last that were not delivered.
std::size_t missing(const std::vector<std::uint32_t>& numbers) {
  return numbers.back() - numbers.front() + 1 - numbers.size();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Scatter of the stamps relative to the start of the frames in the camera, ms: median absolute deviation from the
/// median delay.
double scatter_ms(const std::vector<Grabbed::Frame>& frames, const std::vector<std::int64_t>& began_ns) {
  std::vector<double> late_ms;
  for (std::size_t i = 0; i < frames.size(); ++i)
    late_ms.push_back(static_cast<double>(frames[i].stamp_ns - began_ns[i]) * 1e-6);
  const double common_ms = median(late_ms);
  for (double& late : late_ms) late = std::abs(late - common_ms);
  return median(late_ms);
}

TEST_F(UsbStereoCamera, DeliversSixtyImagesAtThirtyHertzAndCountsWhatABusyMachineLoses) {
  unplug();
  plug_in([this](std::uint32_t number) {
    began_ns_.push_back(Steady::now().time_since_epoch().count());
    return pictures().file(number);
  });
  const Grabbed grabbed(settings());
  ASSERT_TRUE(grabbed.more_come(60)) << grabbed.log();
  const auto all = grabbed.frames();
  const std::vector<Grabbed::Frame> sixty(all.begin(), all.begin() + 60);
  const auto report = grabbed.report();
  EXPECT_EQ(camera_->value("gain"), 42);
  unplug();
  const auto shown = numbers(sixty);
  ASSERT_FALSE(shown.empty()) << "an image is from another eye or another time";
  const std::size_t lost = missing(shown);
  EXPECT_LE(lost, report.counters.dropped + report.counters.damaged + report.counters.incomplete) << grabbed.log();
  // None on an idle machine; a third if the emulated processor gets half a real one.
  constexpr std::size_t kOfABusyMachine = 30;
  EXPECT_LE(lost, kOfABusyMachine) << grabbed.log();
  EXPECT_EQ(report.serial, "SBS001");
  EXPECT_EQ(report.details.at("given"), "MJPG 640 x 240 px, 30 Hz");
  EXPECT_EQ(report.details.at("stamps"), "start of exposure");
  const double seconds = static_cast<double>(sixty.back().stamp_ns - sixty.front().stamp_ns) * 1e-9;
  std::vector<std::int64_t> begun_ns;
  for (const std::uint32_t number : shown) begun_ns.push_back(began_ns_.at(number));
  const double apart_ms = scatter_ms(sixty, begun_ns);
  std::printf("60 of %zu in %.2f s, %zu delivered; stamps %.1f ms from when the camera began\n", 60 + lost, seconds,
              all.size(), apart_ms);
  EXPECT_LT(apart_ms, 1e3 / 30.0 / 2) << "a stamp must be nearer to the start of its own frame than to another";
}

TEST_F(UsbStereoCamera, IsListedByItsSerialNumberWithFormatsAndRates) {
  ASSERT_TRUE(soon([] { return v4l2_camera::find_devices().size() == 1; }));
  const auto device = v4l2_camera::find_devices().at(0);
  EXPECT_EQ(device.serial, "SBS001");
  EXPECT_EQ(device.vendor, "Simulated");
  EXPECT_THAT(device.model, StartsWith("Stereo Camera"));
  EXPECT_EQ(device.protocol, "UVC");
  EXPECT_THAT(device.formats, ElementsAre("MJPG", "YUYV"));
  EXPECT_EQ(device.sizes, "640 x 240 px");
  EXPECT_EQ(device.rates, "5 to 30 Hz");
}

TEST_F(UsbStereoCamera, SendsRawImagesToBothEyes) {
  auto wanted = settings();
  wanted.format = {"YUYV", kWidth, kHeight, 5.0};
  wanted.output = camera_stream::ImageOutput::kReadable;
  const Grabbed grabbed(wanted);
  ASSERT_TRUE(grabbed.more_come(2)) << grabbed.log();
  EXPECT_EQ(grabbed.report().details.at("given"), "YUYV 640 x 240 px, 5 Hz");
  const auto images = grabbed.frames().back().images;
  for (const auto& image : images) {
    EXPECT_EQ(image->encoding(), "bgr8");
    EXPECT_EQ(image->width(), 320u);
    for (const double level : mean_of(*image, 0.0, 1.0)) EXPECT_NEAR(level, (128 - 16) * 255.0 / 219.0, 2.0);
  }
}

TEST_F(UsbStereoCamera, SurvivesFramesThatAreDamaged) {
  const auto part = [](const Bytes& file, std::size_t bytes) {
    return Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(bytes));
  };
  const NumberedPictures small(320, 120);
  // Four of sixteen frames, ten times: each kind occurs even if a busy machine loses a third of the frames.
  constexpr std::uint32_t kRound = 16, kRounds = 10, kCut = 4, kSmall = 8, kHeader = 10, kNoise = 12;
  static_assert(NumberedPictures::kCount % kRound == 0);
  unplug();
  plug_in([&](std::uint32_t number) -> Bytes {
    const Bytes& whole = pictures().file(number);
    if (number >= kRound * kRounds) return whole;
    switch (number % kRound) {
      case kCut:
        return part(whole, whole.size() / 2);
      case kSmall:
        return small.file(number);
      case kHeader:
        return part(whole, 40);
      case kNoise:
        return Bytes(5000, 0x5a);
      default:
        return whole;
    }
  });
  const Grabbed grabbed(settings());
  const auto lost = [&] {
    const auto counters = grabbed.counters();
    return counters.dropped + counters.damaged + counters.incomplete;
  };
  ASSERT_TRUE(grabbed.more_come(kRound * kRounds / 2)) << grabbed.log();
  const auto frames = grabbed.frames();
  const auto shown = numbers(frames);
  ASSERT_FALSE(shown.empty()) << "an image is damaged";
  EXPECT_LE(missing(shown), lost()) << grabbed.log();
  for (const std::uint32_t number : shown) {
    const std::uint32_t kind = number % kRound;
    EXPECT_TRUE(number >= kRound * kRounds || (kind != kCut && kind != kSmall && kind != kHeader && kind != kNoise))
        << number;
  }
  EXPECT_TRUE(grabbed.log_contains("is a damaged JPEG file: Premature end of JPEG file")) << grabbed.log();
  EXPECT_TRUE(grabbed.log_contains("is a JPEG file of 320 x 120 px in a stream of 640 x 240 px")) << grabbed.log();
  EXPECT_TRUE(grabbed.log_contains("is a damaged JPEG file: it ends before the image data")) << grabbed.log();
  EXPECT_TRUE(grabbed.log_contains("is not a JPEG file")) << grabbed.log();
  EXPECT_EQ(grabbed.counters().reconnects, 0u);
  // uvcvideo discards a frame that it knows to be damaged, which leaves a gap in its frame count.
  ASSERT_TRUE(soon([&] { return camera_->sent() > kRound * kRounds; }));
  ASSERT_TRUE(grabbed.more_come(2)) << "all damaged frames are counted";
  const auto before = lost();
  camera_->damage_next();
  EXPECT_TRUE(soon([&] { return lost() > before; })) << grabbed.log();
}

TEST_F(UsbStereoCamera, ComesBackEachTimeItIsPluggedInAgain) {
  const Grabbed grabbed(settings());
  constexpr std::uint64_t kTimes = 20;
  double max_s = 0.0;
  for (std::uint64_t time = 1; time <= kTimes; ++time) {
    ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
    unplug();
    ASSERT_TRUE(soon([&] { return !grabbed.report().is_streaming; })) << grabbed.log();
    plug_in();
    ASSERT_TRUE(soon([] { return !v4l2_camera::list_nodes().empty(); }));
    const auto there = Steady::now();
    ASSERT_TRUE(soon([&] { return grabbed.counters().reconnects == time; })) << time << "\n" << grabbed.log();
    max_s = std::max(max_s, std::chrono::duration<double>(Steady::now() - there).count());
    EXPECT_EQ(camera_->value("gain"), 42) << "set again";
    EXPECT_EQ(grabbed.report().serial, "SBS001");
  }
  std::printf("plugged in again %d times; streaming at most %.2f s after its node was there\n",
              static_cast<int>(kTimes), max_s);
  const auto frames = grabbed.frames();
  for (std::size_t i = 1; i < frames.size(); ++i) ASSERT_GT(frames[i].stamp_ns, frames[i - 1].stamp_ns);
  EXPECT_EQ(grabbed.counters().damaged, 0u) << grabbed.log();
}

TEST_F(UsbStereoCamera, IsNotTakenForAnotherAtItsPort) {
  const Grabbed grabbed(settings());
  ASSERT_TRUE(grabbed.more_come(3)) << grabbed.log();
  unplug();
  camera_ = std::make_unique<UsbCamera>(0, CameraModel{.serial = "OTHER1", .width = kWidth, .height = kHeight},
                                        [](std::uint32_t number) { return pictures().file(number); });
  ASSERT_TRUE(soon([&] { return grabbed.log_contains("SBS001 is no longer connected; available: OTHER1"); }))
      << grabbed.log();
  unplug();
  plug_in();
  EXPECT_TRUE(soon([&] { return grabbed.counters().reconnects == 1; })) << grabbed.log();
}

}  // namespace
}  // namespace panvo::test

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include "live_cameras.hpp"

namespace panvo::aravis_camera::testing {
namespace {

using ::testing::AllOf;
using ::testing::Gt;
using ::testing::HasSubstr;

class GigECameras : public LiveCameras {
 protected:
  /// A pair of small pictures at 60 Hz.
  static ParameterLines pair(const ParameterLines& more = {}) {
    ParameterLines lines{{"layout", {"stereo"}},
                         {"cameras", {"GVL", "GVR"}},
                         {"width", {"128"}},
                         {"height", {"96"}},
                         {"frame_rate_hz", {"60"}}};
    for (const auto& [name, items] : more) lines[name] = items;
    return lines;
  }
  static ParameterLines one(const ParameterLines& more = {}) {
    ParameterLines lines{{"cameras", {"GVL"}}, {"width", {"128"}}, {"height", {"96"}}, {"frame_rate_hz", {"60"}}};
    for (const auto& [name, items] : more) lines[name] = items;
    return lines;
  }

  /// The number of frames of one camera in a simulator's final report.
  static std::uint64_t filled(const std::string& text, const std::string& serial) {
    const auto position = text.find(serial + " filled ");
    return position == std::string::npos ? 0 : std::stoull(text.substr(position + serial.size() + 8));
  }
  /// Number of pictures missing between the first and the last one received.
  static std::uint64_t missing(const std::vector<Seen>& pictures) {
    return pictures.back().picture.number - pictures.front().picture.number + 1 - pictures.size();
  }
};

TEST_F(GigECameras, DeliverWhatWasSentOverTheWrapOfTheFrameNumbers) {
  Simulator& simulator = start({"GVL@127.0.0.1"});
  load(one());
  // The simulator starts at 65400: the number wraps from 65535 to 1 after 136 frames.
  ASSERT_TRUE(eventually([&] { return count(kMono) >= 200; })) << log();
  const std::uint64_t sent = filled(simulator.end(), "GVL");
  const auto accounted_for = [&] {
    return counter("camera", "frames") + counter("camera", "dropped") + counter("camera", "incomplete");
  };
  EXPECT_TRUE(eventually([&] { return accounted_for() == sent; })) << accounted_for() << " of " << sent;
  // On a busy host, the kernel's buffer may overflow: lost frames are counted, as checked above. Otherwise none is
  // lost.
  constexpr std::uint64_t kOfABusyMachine = 2;
  EXPECT_GE(counter("camera", "frames") + kOfABusyMachine, sent);
  EXPECT_EQ(count(kMono), counter("camera", "frames"));
  EXPECT_EQ(counter("camera", "damaged"), 0u);
  const auto pictures = seen(kMono);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    ASSERT_EQ(pictures[i].picture.camera, 0u);
    ASSERT_EQ(pictures[i].encoding, "mono8");
    ASSERT_EQ(pictures[i].width, 128);
    ASSERT_EQ(pictures[i].height, 96);
  }
  EXPECT_LE(missing(pictures), kOfABusyMachine);
  EXPECT_THAT(diagnostics("camera")["camera"], HasSubstr("127.0.0.1"));
  EXPECT_EQ(diagnostics("camera")["image"], "128 x 96 px Mono8");
}

TEST_F(GigECameras, BothHalvesOfAPairBearOneStampAndWereTakenTogether) {
  start({"GVL@127.0.0.1", "GVR@127.0.0.2"});
  load(pair());
  ASSERT_TRUE(eventually([&] { return count(kRight) >= 100; })) << log();
  unload();
  const auto left = seen(kLeft), right = seen(kRight);
  ASSERT_EQ(left.size(), right.size());
  constexpr std::int64_t kHalfAPeriod_ns = 8'000'000;  // of 60 Hz
  // A busy host may receive the first frames of one camera late, and so pair frames of neighbouring times.
  constexpr std::size_t kFirst = 3;
  for (std::size_t i = 0; i < left.size(); ++i) {
    ASSERT_EQ(left[i].stamp_ns, right[i].stamp_ns);
    ASSERT_EQ(left[i].picture.camera, 0u);
    ASSERT_EQ(right[i].picture.camera, 1u);
    if (i >= kFirst) {
      ASSERT_LT(std::abs(left[i].picture.taken_ns - right[i].picture.taken_ns), kHalfAPeriod_ns) << i;
    }
    if (i > 0) {
      ASSERT_GT(left[i].stamp_ns, left[i - 1].stamp_ns);
    }
  }
}

TEST_F(GigECameras, CountTheFramesWhoseNumbersAreLeftOut) {
  start({"--skip-every", "10", "GVL@127.0.0.1"});
  load(one());
  ASSERT_TRUE(eventually([&] { return counter("camera", "frames") >= 150; })) << log();
  const auto frames = counter("camera", "frames"), dropped = counter("camera", "dropped");
  EXPECT_NEAR(static_cast<double>(dropped), static_cast<double>(frames) / 10.0, 1.0);
  EXPECT_LE(missing(seen(kMono)), counter("camera", "incomplete") + 1) << "only numbers are skipped, not pictures";
  EXPECT_EQ(diagnostics("camera")["level"], "1");
  EXPECT_THAT(diagnostics("camera")["message"], HasSubstr("dropped"));
}

TEST_F(GigECameras, CountPicturesThatLostPacketsAndSayWhatHelps) {
  start({"--lost-ratio", "0.02", "GVL@127.0.0.1"});
  load(one({{"resend", {"false"}}, {"packet_size", {"1000"}}}));
  ASSERT_TRUE(eventually([&] { return counter("camera", "incomplete") >= 10 && counter("camera", "frames") >= 10; }))
      << log();
  EXPECT_TRUE(log_contains("delivers incomplete frames")) << log();
  EXPECT_TRUE(log_contains("packet_delay_ns")) << "the remedy";
  const auto pictures = seen(kMono);
  for (const auto& each : pictures) ASSERT_EQ(each.picture.camera, 0u) << "only complete pictures are published";
  // Missing pictures are those counted as incomplete or dropped.
  ASSERT_TRUE(eventually([&] { return counter("camera", "frames") > pictures.size(); }));
  const auto lost = counter("camera", "incomplete") + counter("camera", "dropped");
  const auto later = seen(kMono);
  EXPECT_NEAR(static_cast<double>(missing(later)), static_cast<double>(lost), 60.0) << "diagnostics lag by up to 1 s";
  EXPECT_GT(missing(later), 0u);
}

TEST_F(GigECameras, AreStampedByTheHostsClockWhateverTheirOwnShows) {
  start({"--offset-s", "10", "--drift-ppm", "100", "GVL@127.0.0.1", "GVR@127.0.0.2"});
  load(pair());
  constexpr std::size_t kFrames = 900;  // 15 s
  ASSERT_TRUE(eventually([&] { return count(kLeft) >= kFrames; })) << log();
  unload();
  std::vector<double> errors_ms;
  const auto pictures = seen(kLeft);
  for (std::size_t i = 600; i < kFrames; ++i)
    errors_ms.push_back(std::abs(static_cast<double>(pictures[i].stamp_ns - pictures[i].picture.taken_ns)) * 1e-6);
  std::sort(errors_ms.begin(), errors_ms.end());
  std::printf("error of the stamps after 10 s: median %.3f ms, largest %.3f ms\n", errors_ms[errors_ms.size() / 2],
              errors_ms.back());
  EXPECT_LT(errors_ms.back(), 1.0);
  EXPECT_EQ(counter("left", "resets of the camera's clock"), 0u);
}

TEST_F(GigECameras, AreTriggeredFromHere) {
  start({"GVL@127.0.0.1", "GVR@127.0.0.2"});
  load(pair({{"trigger", {"software"}}, {"software_trigger_hz", {"20"}}}));
  ASSERT_TRUE(eventually([&] { return count(kLeft) >= 40; })) << log();
  unload();
  const auto pictures = seen(kLeft);
  std::vector<std::int64_t> steps_ns;
  for (std::size_t i = 1; i < pictures.size(); ++i)
    steps_ns.push_back(pictures[i].picture.taken_ns - pictures[i - 1].picture.taken_ns);
  std::sort(steps_ns.begin(), steps_ns.end());
  const double median_ms = static_cast<double>(steps_ns[steps_ns.size() / 2]) * 1e-6;
  EXPECT_GT(median_ms, 30.0) << "17 ms if free running";
  EXPECT_LT(median_ms, 90.0) << "50 ms, plus or minus the simulated camera's polling interval";
}

TEST_F(GigECameras, AreHeardWhetherOrNotThePacketSocketHearsThem) {
  start({"GVL@127.0.0.1"});
  load(one({{"packet_socket", {"auto"}}}));
  ASSERT_TRUE(eventually([&] { return count(kMono) >= 20; })) << log();
}

TEST_F(GigECameras, SendColourAsTheOthersReadItOrAsItIs) {
  start({"GVL@127.0.0.1"});
  load(one({{"pixel_format", {"BayerRG8"}}}));
  ASSERT_TRUE(eventually([&] { return count(kMono) >= 5; })) << log();
  EXPECT_EQ(seen(kMono).back().encoding, "bgr8");
  unload();
  const auto before = count(kMono);
  load(one({{"pixel_format", {"BayerRG8"}}, {"encoding", {"as_sent"}}}));
  ASSERT_TRUE(eventually([&] { return count(kMono) >= before + 5; })) << log();
  EXPECT_EQ(seen(kMono).back().encoding, "bayer_rggb8");
  EXPECT_EQ(seen(kMono).back().picture.camera, 0u) << "byte for byte";
}

}  // namespace
}  // namespace panvo::aravis_camera::testing

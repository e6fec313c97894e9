// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <csignal>
#include <memory>

#include "live_cameras.hpp"
#include "panvo/aravis_camera/camera_grabber.hpp"

namespace panvo::aravis_camera::testing {
namespace {

class LostCameras : public LiveCameras {
 protected:
  static constexpr int kTimes = 3;

  static std::vector<std::string> both() { return {"GVL@127.0.0.1", "GVR@127.0.0.2"}; }
  static ParameterLines pair() {
    return {{"layout", {"stereo"}},
            {"cameras", {"GVL", "GVR"}},
            {"width", {"160"}},
            {"height", {"120"}},
            {"frame_rate_hz", {"60"}}};
  }
  /// Waits for further pictures on both topics.
  bool more_come() {
    const auto left = count(kLeft), right = count(kRight);
    return eventually([&] { return count(kLeft) > left + 5 && count(kRight) > right + 5; });
  }
  void expect_stamps_to_increase() {
    for (const char* topic : {kLeft, kRight}) {
      const auto pictures = seen(topic);
      for (std::size_t i = 1; i < pictures.size(); ++i)
        ASSERT_GT(pictures[i].stamp_ns, pictures[i - 1].stamp_ns) << topic;
    }
  }
};

TEST_F(LostCameras, ComeBackWithTheirSettingsWhenTheyWereKilled) {
  auto simulator = std::make_unique<Simulator>(both());
  load(pair());
  ASSERT_TRUE(more_come()) << log();
  for (int i = 1; i <= kTimes; ++i) {
    simulator->kill();
    ASSERT_TRUE(eventually([&] { return diagnostics("left")["level"] == "2" && diagnostics("right")["level"] == "2"; }))
        << log();
    // After the restart, the camera has its default width, height and rate again.
    simulator = std::make_unique<Simulator>(both());
    ASSERT_TRUE(more_come()) << "time " << i << "\n" << log();
    EXPECT_EQ(seen(kLeft).back().width, 160);
    EXPECT_EQ(seen(kRight).back().height, 120);
    EXPECT_EQ(seen(kRight).back().picture.camera, 1u);
    const auto times = static_cast<std::uint64_t>(i);
    ASSERT_TRUE(eventually([&] {
      return counter("left", "reconnects") == times && counter("right", "reconnects") == times;
    })) << log();
  }
  EXPECT_EQ(diagnostics("left")["camera"], "Aravis Fake at 127.0.0.1") << "same serial number, same address";
  unload();
  expect_stamps_to_increase();
}

TEST_F(LostCameras, ComeBackWhenTheyWereStoppedForLongerThanTheWatchdogWaits) {
  const auto& simulator = start(both());
  load(pair());
  for (int i = 1; i <= kTimes; ++i) {
    ASSERT_TRUE(more_come()) << log();
    ASSERT_TRUE(
        eventually([&] { return diagnostics("left")["level"] != "2" && diagnostics("right")["level"] != "2"; }));
    simulator.signal(SIGSTOP);
    ASSERT_TRUE(eventually([&] { return diagnostics("left")["level"] == "2" && diagnostics("right")["level"] == "2"; }))
        << log();
    simulator.signal(SIGCONT);
  }
  ASSERT_TRUE(more_come()) << log();
  ASSERT_TRUE(eventually([&] {
    return counter("left", "reconnects") == kTimes && counter("right", "reconnects") == kTimes;
  })) << log();
  unload();
  expect_stamps_to_increase();
}

TEST_F(LostCameras, AreSetWhileTheyStreamAndAgainWhenTheyComeBack) {
  auto simulator = std::make_unique<Simulator>(std::vector<std::string>{"GVL@127.0.0.1"});
  const runtime::Logger silent("test", [](runtime::LogLevel, const std::string&, const std::string&) {});
  std::mutex mutex;
  std::vector<std::int64_t> steps_ns;  // between the exposures of successive pictures
  std::int64_t last_ns = 0;
  GrabberSettings settings;
  settings.name = "left";
  settings.camera.camera = "GVL";
  settings.camera.frame_rate_hz = 0.0;
  settings.camera.packet_socket = PacketSocket::kOff;
  CameraGrabber grabber(settings, silent, [&](const CameraGrabber::Frame& frame) {
    const auto picture = TestPicture::read(frame.images[0]->data(), frame.images[0]->step());
    const std::lock_guard lock(mutex);
    if (picture && last_ns != 0) steps_ns.push_back(picture->taken_ns - last_ns);
    last_ns = picture ? picture->taken_ns : 0;
  });
  const auto takes_ten_pictures_each = [&](double period_ms) {
    return eventually([&] {
      const std::lock_guard lock(mutex);
      if (steps_ns.size() < 10) return false;
      std::vector<std::int64_t> newest(steps_ns.end() - 10, steps_ns.end());
      std::nth_element(newest.begin(), newest.begin() + 5, newest.end());
      return std::abs(static_cast<double>(newest[5]) * 1e-6 - period_ms) < 0.2 * period_ms;
    });
  };
  EXPECT_TRUE(takes_ten_pictures_each(40.0)) << "the simulator's default of 25 Hz";
  grabber.set({{"AcquisitionFrameRate", "100"}, {"NoSuchThing", "1"}});
  EXPECT_TRUE(takes_ten_pictures_each(10.0));
  EXPECT_TRUE(eventually([&] { return grabber.report().counters.refused_settings == 1; }));
  simulator->kill();
  simulator = std::make_unique<Simulator>(std::vector<std::string>{"GVL@127.0.0.1"});
  ASSERT_TRUE(eventually([&] { return grabber.report().counters.reconnects == 1; }));
  {
    const std::lock_guard lock(mutex);
    steps_ns.clear();
  }
  EXPECT_TRUE(takes_ten_pictures_each(10.0)) << "as set last";
  EXPECT_EQ(grabber.report().counters.refused_settings, 1u);
}

TEST_F(LostCameras, LeaveTheOtherHalfOfThePairUnpairedUntilTheyComeBack) {
  start({"GVL@127.0.0.1"});
  auto right = std::make_unique<Simulator>(std::vector<std::string>{"GVR@127.0.0.2"});
  load(pair());
  ASSERT_TRUE(more_come()) << log();
  right->kill();
  ASSERT_TRUE(eventually([&] { return counter("left", "unpaired") > 20; })) << log();
  EXPECT_EQ(diagnostics("left")["state"], "streaming");
  EXPECT_EQ(counter("left", "reconnects"), 0u);
  right = std::make_unique<Simulator>(std::vector<std::string>{"GVR@127.0.0.2"});
  ASSERT_TRUE(more_come()) << log();
  unload();
  EXPECT_EQ(seen(kLeft).size(), seen(kRight).size());
}

TEST_F(LostCameras, AreAwaitedFromTheStart) {
  load(pair());
  ASSERT_TRUE(eventually([&] { return log_contains("camera 'GVL' not found"); })) << log();
  start(both());
  EXPECT_TRUE(more_come()) << log();
}

TEST_F(LostCameras, AreFoundWhereTheyAreNow) {
  auto simulator = std::make_unique<Simulator>(std::vector<std::string>{"GVL@127.0.0.1"});
  load({{"cameras", {"GVL"}}});
  ASSERT_TRUE(eventually([&] { return count(kMono) > 5; })) << log();
  simulator->kill();
  simulator = std::make_unique<Simulator>(std::vector<std::string>{"GVL@127.0.0.2"});
  ASSERT_TRUE(eventually([&] { return diagnostics("camera")["camera"] == "Aravis Fake at 127.0.0.2"; })) << log();
  const auto before = count(kMono);
  EXPECT_TRUE(eventually([&] { return count(kMono) > before + 5; })) << log();
}

TEST_F(LostCameras, AreNotTakenForAnotherOneAtTheirPlace) {
  auto simulator = std::make_unique<Simulator>(std::vector<std::string>{"GVL@127.0.0.1"});
  load({{"cameras", {"GVL"}}});
  ASSERT_TRUE(eventually([&] { return count(kMono) > 5; })) << log();
  simulator->kill();
  simulator = std::make_unique<Simulator>(std::vector<std::string>{"GVX@127.0.0.1"});
  EXPECT_TRUE(eventually([&] { return log_contains("is now GVX; waiting for GVL"); })) << log();
}

}  // namespace
}  // namespace panvo::aravis_camera::testing

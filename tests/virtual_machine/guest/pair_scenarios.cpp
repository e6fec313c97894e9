// SPDX-License-Identifier: Apache-2.0
// The component in a live container with two USB cameras as a stereo pair: image sets with one stamp, diagnostics, a
// missing camera.
#include <gtest/gtest.h>

#include <map>
#include <mutex>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "numbered_pictures.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/runtime/container.hpp"
#include "process.hpp"
#include "sensor_msgs/msg/Image.h"
#include "usb_camera.hpp"

namespace panvo::test {
namespace {

constexpr int kWidth = 320, kHeight = 120;
constexpr const char* kLeft = "/stereo/left/image_raw";
constexpr const char* kRight = "/stereo/right/image_raw";

/// Collects the messages that the component publishes.
class LivePair : public ::testing::Test {
 protected:
  void SetUp() override {
    plug_in(0);
    plug_in(1);
    runtime::ContainerOptions options;
    options.log = [this](runtime::LogLevel, const std::string&, const std::string& text) {
      const std::lock_guard lock(mutex_);
      log_ += text + "\n";
    };
    container_ = std::make_unique<runtime::Container>(std::move(options));
    container_->observe(
        [](const runtime::TopicDescription&) { return true; },
        [this](const runtime::TopicDescription& topic, const runtime::SamplePtr& sample) { take(topic.name, sample); });
    runtime::ComponentDescription description;
    description.package = "panvo_v4l2_camera";
    description.plugin = "V4l2CameraComponent";
    description.name = "v4l2_camera";
    description.name_space = std::string("/");
    set(description, "layout", {"stereo"});
    set(description, "cameras", {"PAIR0", "PAIR1"});
    set(description, "controls", {"gain=20", "right:gain=30"});
    set(description, "pixel_format", {"MJPG"});
    set(description, "frame_rate_hz", {"15.0"});
    set(description, "pair_tolerance_ms", {"33"});
    set(description, "encoding", {"grey"});
    container_->load(description);
    container_->start();
  }
  void TearDown() override { container_.reset(); }

  static void set(runtime::ComponentDescription& description, const std::string& name,
                  const std::vector<std::string>& values) {
    const bool is_list = name == "cameras" || name == "controls";
    description.parameters[name] = runtime::WrittenValue{values, is_list, {"test", 0}};
  }

  void plug_in(int port) {
    static const NumberedPictures pictures(kWidth, kHeight);
    const CameraModel model{.serial = "PAIR" + std::to_string(port), .width = kWidth, .height = kHeight, .rate_hz = 15};
    cameras_[port] =
        std::make_unique<UsbCamera>(port, model, [](std::uint32_t number) { return pictures.file(number); });
  }

  void take(const std::string& topic, const runtime::SamplePtr& sample) {
    const std::lock_guard lock(mutex_);
    if (topic == "/diagnostics") {
      for (const auto& status : runtime::Sample::as<diagnostic_msgs::msg::DiagnosticArray>(sample)->status()) {
        auto& values = diagnostics_[status.name()];
        values["message"] = status.message();
        for (const auto& entry : status.values()) values[entry.key()] = entry.value();
      }
    } else if (topic == kLeft || topic == kRight) {
      stamps_[topic].push_back(conversions::stamp_ns(*runtime::Sample::as<sensor_msgs::msg::Image>(sample)));
    }
  }

  std::vector<std::int64_t> stamps(const char* topic) {
    const std::lock_guard lock(mutex_);
    return stamps_[topic];
  }
  std::string diagnostic(const std::string& camera, const std::string& key) {
    const std::lock_guard lock(mutex_);
    return diagnostics_["panvo: v4l2_camera: " + camera][key];
  }
  std::string log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }
  bool more_pairs_come() {
    const auto before = stamps(kRight).size();
    return eventually([&] { return stamps(kRight).size() >= before + 10; }, std::chrono::seconds(20));
  }

  std::map<int, std::unique_ptr<UsbCamera>> cameras_;

 private:
  std::mutex mutex_;
  std::map<std::string, std::vector<std::int64_t>> stamps_;
  std::map<std::string, std::map<std::string, std::string>> diagnostics_;
  std::string log_;
  std::unique_ptr<runtime::Container> container_;
};

TEST_F(LivePair, BearsOneStampAndGoesOnWhenTheOneThatWasAwayIsBack) {
  ASSERT_TRUE(more_pairs_come()) << log();
  EXPECT_EQ(cameras_[0]->value("gain"), 20);
  EXPECT_EQ(cameras_[1]->value("gain"), 30);

  cameras_[1].reset();
  ASSERT_TRUE(
      eventually([&] { return diagnostic("right", "state").starts_with("not connected"); }, std::chrono::seconds(20)))
      << log();
  const auto unpaired = [&] { return std::stoi(diagnostic("left", "unpaired")); };
  const int before = unpaired();
  ASSERT_TRUE(eventually([&] { return unpaired() > before + 5; }, std::chrono::seconds(20))) << log();
  EXPECT_EQ(diagnostic("left", "state"), "streaming");
  plug_in(1);
  ASSERT_TRUE(more_pairs_come()) << log();
  EXPECT_TRUE(eventually([&] { return diagnostic("right", "reconnects") == "1"; })) << log();
  EXPECT_EQ(diagnostic("left", "reconnects"), "0");
  EXPECT_EQ(cameras_[1]->value("gain"), 30) << "set again";
  for (const char* key : {"frames", "dropped", "damaged", "incomplete", "failed tries to open", "refused settings",
                          "age of the newest frame", "asked", "given", "stamps", "rate"})
    EXPECT_NE(diagnostic("right", key), "") << key;

  const auto left = stamps(kLeft), right = stamps(kRight);
  const std::size_t sets = std::min(left.size(), right.size());
  ASSERT_GE(sets, 20u);
  for (std::size_t i = 0; i < sets; ++i) {
    ASSERT_EQ(left[i], right[i]);
    if (i > 0) {
      ASSERT_GT(left[i], left[i - 1]);
    }
  }
}

}  // namespace
}  // namespace panvo::test

// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_stream/stream_counters.hpp"

#include <gmock/gmock.h>

namespace panvo::camera_stream {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

StreamReport report_of(const StreamCounters& counters) {
  return {.name = "left",
          .serial = "GVL",
          .is_streaming = true,
          .state = "streaming",
          .remedy = "larger packets",
          .counters = counters,
          .details = {{"pixel format", "Mono8"}}};
}

std::string value_of(const diagnostic_msgs::msg::DiagnosticStatus& status, const std::string& key) {
  for (const auto& entry : status.values()) {
    if (entry.key() == key) return entry.value();
  }
  return "no such key";
}

TEST(StreamCounters, AreAllToldWithTheRateAndTheAge) {
  const StreamCounters counters{.frames = 160,
                                .dropped = 1,
                                .damaged = 2,
                                .incomplete = 3,
                                .resent = 4,
                                .unpaired = 5,
                                .reconnects = 6,
                                .failed_opens = 7,
                                .refused_settings = 0,
                                .clock_resets = 8,
                                .newest_stamp_ns = 10 * kSecond_ns};
  StreamCounters before = counters;
  before.frames = 100;
  const auto status = to_status("aravis_camera", report_of(counters), before, 10 * kSecond_ns + kSecond_ns / 4, 2.0);
  EXPECT_EQ(status.name(), "panvo: aravis_camera: left");
  EXPECT_EQ(status.hardware_id(), "GVL");
  EXPECT_EQ(status.level(), 0);
  const std::pair<const char*, const char*> expected[] = {{"rate", "30.0 Hz"},
                                                          {"frames", "160"},
                                                          {"dropped", "1"},
                                                          {"damaged", "2"},
                                                          {"incomplete", "3"},
                                                          {"resent packets", "4"},
                                                          {"unpaired", "5"},
                                                          {"reconnects", "6"},
                                                          {"failed tries to open", "7"},
                                                          {"resets of the camera's clock", "8"},
                                                          {"age of the newest frame", "0.250 s"},
                                                          {"pixel format", "Mono8"}};
  for (const auto& [key, value] : expected) EXPECT_EQ(value_of(status, key), value) << key;
}

TEST(StreamCounters, WarnWhileSomethingIsLost) {
  StreamCounters before, now;
  before.dropped = 5;
  now.dropped = 7;
  now.incomplete = 3;
  const auto status = to_status("aravis_camera", report_of(now), before, 0, 1.0);
  EXPECT_EQ(status.level(), 1);
  EXPECT_EQ(status.message(), "in the last 1 s: 2 dropped, 3 incomplete; larger packets");
  EXPECT_EQ(to_status("aravis_camera", report_of(now), now, 0, 1.0).level(), 0);
}

TEST(StreamCounters, WarnOfSettingsThatTheCameraRefused) {
  StreamCounters counters;
  counters.refused_settings = 2;
  const auto status = to_status("aravis_camera", report_of(counters), counters, 0, 1.0);
  EXPECT_EQ(status.level(), 1);
  EXPECT_THAT(status.message(), HasSubstr("2 settings refused"));
}

TEST(StreamCounters, AreAnErrorWhileNothingComes) {
  auto report = report_of({});
  report.is_streaming = false;
  report.serial.clear();
  report.state = "not connected: camera 'GVL' not found";
  const auto status = to_status("aravis_camera", report, {}, 0, 1.0);
  EXPECT_EQ(status.level(), 2);
  EXPECT_EQ(status.message(), "not connected: camera 'GVL' not found");
  EXPECT_EQ(status.hardware_id(), "none");
  EXPECT_EQ(value_of(status, "age of the newest frame"), "no frame yet");
}

}  // namespace
}  // namespace panvo::camera_stream

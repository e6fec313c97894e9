// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "own_network.hpp"
#include "panvo/runtime/container.hpp"
#include "simulator.hpp"
#include "test_picture.hpp"

namespace panvo::aravis_camera::testing {

using ParameterLines = std::map<std::string, std::vector<std::string>>;

/// Runs the component in a live container, with simulated cameras in their own network namespace. Skips the test, with
/// the reason, if no namespace can be created.
class LiveCameras : public ::testing::Test {
 protected:
  /// A published picture.
  struct Seen {
    std::int64_t stamp_ns = 0;
    TestPicture picture;  ///< number 0 of camera 99 if it is not a test picture
    std::string encoding;
    int width = 0, height = 0;
  };

  void SetUp() override {
    if (const auto why_not = enter_own_network(); !why_not.empty()) GTEST_SKIP() << why_not;
  }

  /// Starts simulated cameras, which outlive the driver.
  Simulator& start(const std::vector<std::string>& words);
  /// Loads the component, by default with UDP sockets, because packet sockets receive nothing on loopback.
  void load(const ParameterLines& parameters);
  void unload();

  /// Polls the condition every few milliseconds; false if it is not met within a minute.
  [[nodiscard]] static bool eventually(const std::function<bool()>& condition);

  /// The pictures published so far on a topic ("/stereo/left/image_raw").
  std::vector<Seen> seen(const std::string& topic) const;
  std::size_t count(const std::string& topic) const;
  /// The newest diagnostics of a camera, by key, with "level" and "message"; empty: none yet.
  std::map<std::string, std::string> diagnostics(const std::string& camera) const;
  std::uint64_t counter(const std::string& camera, const std::string& key) const;
  bool log_contains(const std::string& text) const;
  std::string log() const;

  static constexpr const char* kLeft = "/stereo/left/image_raw";
  static constexpr const char* kRight = "/stereo/right/image_raw";
  static constexpr const char* kMono = "/camera/image_raw";

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<Seen>> seen_;
  std::map<std::string, std::size_t> counts_;
  std::map<std::string, std::map<std::string, std::string>> diagnostics_;
  std::vector<std::string> log_;
  std::vector<std::unique_ptr<Simulator>> simulators_;
  std::unique_ptr<runtime::Container> container_;
};

}  // namespace panvo::aravis_camera::testing

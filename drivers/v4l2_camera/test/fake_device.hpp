// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "panvo/v4l2_camera/camera_grabber.hpp"

namespace panvo::v4l2_camera::testing {

/// Simulates plugged-in cameras without the kernel. Thread-safe.
class FakeUsb {
 public:
  struct Camera {
    VideoNode node;
    std::vector<OfferedFormat> formats{
        {pixel_code('G', 'R', 'E', 'Y'), "Greyscale", {{.width = 4, .height = 2, .rates_hz = {30.0}}}}};
    ImageFormat format{pixel_code('G', 'R', 'E', 'Y'), 4, 2, 4};
    double rate_hz = 30.0;  ///< 0: unknown
    std::map<std::string, std::int64_t> values{{"gain", 10}, {"brightness", 5}};
    std::optional<DeviceError> open_error{}, start_error{};  ///< thrown while set
    bool is_unplugged = false;
    std::deque<BufferedFrame> waiting{};
    std::vector<std::vector<std::uint8_t>> memory{};
    int given_back = 0, opened = 0, starts = 0;
  };

  std::shared_ptr<Camera> plug_in(const VideoNode& node);
  /// Operations on the open camera fail from now on. A later plug_in() creates it with default settings.
  void unplug(const std::string& path);
  /// Sends a frame of that camera, stamped now.
  void send(const std::string& path, std::uint32_t number, std::vector<std::uint8_t> bytes, bool is_damaged = false);
  /// Calls `function` with the cameras, under the lock.
  template <class Function>
  auto with(Function function) {
    const std::lock_guard lock(mutex_);
    return function(cameras_);
  }

  /// The functions that a grabber needs.
  Devices devices();

 private:
  friend class FakeDevice;
  std::mutex mutex_;
  std::condition_variable sent_;
  std::map<std::string, std::shared_ptr<Camera>> cameras_;
};

}  // namespace panvo::v4l2_camera::testing

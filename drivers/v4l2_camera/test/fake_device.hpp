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

/// What is plugged in, and what the devices are to do: cameras without a kernel. All of it from any thread.
class FakeUsb {
 public:
  struct Camera {
    VideoNode node;
    std::vector<OfferedFormat> formats{
        {pixel_code('G', 'R', 'E', 'Y'), "Greyscale", {{.width = 4, .height = 2, .rates_hz = {30.0}}}}};
    ImageFormat format{pixel_code('G', 'R', 'E', 'Y'), 4, 2, 4};
    std::map<std::string, std::int64_t> values{{"gain", 10}, {"brightness", 5}};
    std::optional<DeviceError> open_error{}, start_error{};  ///< to be thrown as long as they are there
    bool is_unplugged = false;
    std::deque<BufferedFrame> waiting{};
    std::vector<std::vector<std::uint8_t>> memory{};
    int given_back = 0, opened = 0, starts = 0;
  };

  std::shared_ptr<Camera> plug_in(const VideoNode& node);
  /// Whoever has the camera open learns that it is gone; it comes back by plug_in() and has forgotten its settings.
  void unplug(const std::string& path);
  /// A frame of that camera, taken now.
  void send(const std::string& path, std::uint32_t number, std::vector<std::uint8_t> bytes, bool is_damaged = false);
  /// Looks at, or changes, what there is.
  template <class Function>
  auto with(Function function) {
    const std::lock_guard lock(mutex_);
    return function(cameras_);
  }

  /// For a grabber.
  Devices devices();

 private:
  friend class FakeDevice;
  std::mutex mutex_;
  std::condition_variable sent_;
  std::map<std::string, std::shared_ptr<Camera>> cameras_;
};

}  // namespace panvo::v4l2_camera::testing

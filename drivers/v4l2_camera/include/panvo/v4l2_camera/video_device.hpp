// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "panvo/v4l2_camera/control.hpp"
#include "panvo/v4l2_camera/format_choice.hpp"

namespace panvo::v4l2_camera {

/// An operation on a device that failed; what() says which, why and what to do.
class DeviceError : public std::runtime_error {
 public:
  enum class Kind : std::uint8_t {
    kGone,        ///< unplugged, or broken down
    kBusy,        ///< another program has it
    kNotAllowed,  ///< this user may not open it
    kOther,
  };
  DeviceError(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
  Kind kind() const noexcept { return kind_; }

 private:
  Kind kind_;
};

/// A frame in one of the device's buffers.
struct BufferedFrame {
  std::span<const std::uint8_t> bytes{};
  std::uint32_t number = 0;                    ///< the driver's count of frames, those that were lost with them
  std::optional<std::int64_t> monotonic_ns{};  ///< when, by CLOCK_MONOTONIC; nullopt: stamped by another clock, or not
  bool is_stamped_at_start = false;            ///< of the exposure; otherwise when it had come
  bool is_damaged = false;                     ///< the driver says so
  unsigned buffer = 0;
};

/// A camera that is open: what the rest of the driver knows of V4L2. Everything may throw DeviceError.
class VideoDevice {
 public:
  VideoDevice() = default;
  virtual ~VideoDevice() = default;
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;

  virtual std::vector<OfferedFormat> offered_formats() = 0;
  virtual ImageFormat format() = 0;
  /// Returns what the camera makes of it.
  virtual ImageFormat set_format(const ImageFormat& wanted) = 0;
  /// 0: not known.
  virtual double rate_hz() = 0;
  /// Returns what the camera makes of it; 0: it does not let its rate be set.
  virtual double set_rate_hz(double wanted_hz) = 0;
  virtual std::vector<Control> controls() = 0;
  virtual void set_control(const Control& control, std::int64_t value) = 0;
  virtual std::int64_t control(const Control& control) = 0;

  virtual void start(int buffers) = 0;
  /// nullopt: none came within `limit`. A frame's buffer is the caller's until it is given back.
  virtual std::optional<BufferedFrame> receive(std::chrono::milliseconds limit) = 0;
  virtual void give_back(const BufferedFrame& frame) = 0;
};

/// Opens a device node with the kernel's V4L2. Throws DeviceError.
std::unique_ptr<VideoDevice> open_video_device(const std::string& node);

}  // namespace panvo::v4l2_camera

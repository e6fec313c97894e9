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

/// A failed operation on a device; what() gives operation, cause and remedy.
class DeviceError : public std::runtime_error {
 public:
  enum class Kind : std::uint8_t {
    kGone,        ///< unplugged or defective
    kBusy,        ///< in use by another program
    kNotAllowed,  ///< no permission to open it
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
  std::uint32_t number = 0;                    ///< the driver's frame count, including lost frames
  std::optional<std::int64_t> monotonic_ns{};  ///< stamp, CLOCK_MONOTONIC; nullopt: another clock, or not stamped
  bool is_stamped_at_start = false;            ///< at the start of exposure; otherwise at the end of the frame
  bool is_damaged = false;                     ///< according to the driver
  unsigned buffer = 0;
};

/// An open camera: the driver's interface to V4L2. All functions may throw DeviceError.
class VideoDevice {
 public:
  VideoDevice() = default;
  virtual ~VideoDevice() = default;
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;

  virtual std::vector<OfferedFormat> offered_formats() = 0;
  virtual ImageFormat format() = 0;
  /// Returns the format that the camera actually set.
  virtual ImageFormat set_format(const ImageFormat& wanted) = 0;
  /// 0: not known.
  virtual double rate_hz() = 0;
  /// Returns the rate that the camera actually set; 0: it does not support setting the rate.
  virtual double set_rate_hz(double wanted_hz) = 0;
  virtual std::vector<Control> controls() = 0;
  virtual void set_control(const Control& control, std::int64_t value) = 0;
  virtual std::int64_t control(const Control& control) = 0;

  virtual void start(int buffers) = 0;
  /// nullopt: no frame within `limit`. The caller owns the frame's buffer until it calls give_back().
  virtual std::optional<BufferedFrame> receive(std::chrono::milliseconds limit) = 0;
  virtual void give_back(const BufferedFrame& frame) = 0;
};

/// Opens a device node with the kernel's V4L2. Throws DeviceError.
std::unique_ptr<VideoDevice> open_video_device(const std::string& node);

}  // namespace panvo::v4l2_camera

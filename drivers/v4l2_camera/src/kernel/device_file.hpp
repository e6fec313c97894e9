// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "panvo/v4l2_camera/video_device.hpp"

struct v4l2_fract;

namespace panvo::v4l2_camera::kernel {

/// Converts an operation's errno to an error with a remedy.
DeviceError error_of(const std::string& node, const char* operation, int code);

/// An open device node and its ioctl requests. Throws DeviceError.
class DeviceFile {
 public:
  explicit DeviceFile(std::string node);
  /// If the camera is unplugged, waits until the kernel has removed it, at most 1 s.
  ~DeviceFile();
  DeviceFile(const DeviceFile&) = delete;
  DeviceFile& operator=(const DeviceFile&) = delete;

  /// False if the request fails; errno has the cause.
  bool try_request(unsigned long code, void* argument) const;
  /// `name`: of the request, for the error message.
  void request(unsigned long code, void* argument, const char* name) const;

  const std::string& node() const noexcept { return node_; }
  int descriptor() const noexcept { return descriptor_; }

 private:
  bool is_removed() const;

  std::string node_;
  int descriptor_;
  std::filesystem::path usb_interface_;  // its folder in sysfs; empty: not a USB camera
};

/// The text in a field of fixed size.
std::string text_of(const std::uint8_t* text, std::size_t size);

/// Converts a frame interval to a rate in Hz; 0 if unspecified.
double rate_of(const v4l2_fract& interval);

/// Lists all formats with their sizes and rates.
std::vector<OfferedFormat> offered_formats(const DeviceFile& file);

/// Lists the controls with numeric values.
std::vector<Control> controls_of(const DeviceFile& file);
void set_control(const DeviceFile& file, const Control& control, std::int64_t value);
std::int64_t get_control(const DeviceFile& file, const Control& control);

}  // namespace panvo::v4l2_camera::kernel

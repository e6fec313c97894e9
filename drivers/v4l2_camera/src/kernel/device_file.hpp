// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "panvo/v4l2_camera/video_device.hpp"

struct v4l2_fract;

namespace panvo::v4l2_camera::kernel {

/// What an operation's errno means for the user.
DeviceError error_of(const std::string& node, const char* operation, int code);

/// A device node that is open, and what is asked of it. Throws DeviceError.
class DeviceFile {
 public:
  explicit DeviceFile(std::string node);
  ~DeviceFile();
  DeviceFile(const DeviceFile&) = delete;
  DeviceFile& operator=(const DeviceFile&) = delete;

  /// False when the kernel refuses; errno says why.
  bool try_request(unsigned long code, void* argument) const;
  /// `name` is the request's, for the message.
  void request(unsigned long code, void* argument, const char* name) const;

  const std::string& node() const noexcept { return node_; }
  int descriptor() const noexcept { return descriptor_; }

 private:
  std::string node_;
  int descriptor_;
};

/// A text in a field of fixed size.
std::string text_of(const std::uint8_t* text, std::size_t size);

/// Frames a second of the time between two; 0 where none is said.
double rate_of(const v4l2_fract& interval);

/// All formats with their sizes and rates.
std::vector<OfferedFormat> offered_formats(const DeviceFile& file);

/// The controls that have a value which is a number.
std::vector<Control> controls_of(const DeviceFile& file);
void set_control(const DeviceFile& file, const Control& control, std::int64_t value);
std::int64_t get_control(const DeviceFile& file, const Control& control);

}  // namespace panvo::v4l2_camera::kernel

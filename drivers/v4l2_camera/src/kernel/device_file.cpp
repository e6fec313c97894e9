// SPDX-License-Identifier: Apache-2.0
#include "kernel/device_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace panvo::v4l2_camera::kernel {

DeviceError error_of(const std::string& node, const char* operation, int code) {
  using Kind = DeviceError::Kind;
  switch (code) {
    case ENODEV:
    case ENXIO:
    case ENOENT:
      return {Kind::kGone, fmt::format("{} does not exist or was disconnected: is the camera plugged in?", node)};
    case EIO:
    case EPIPE:
    case EPROTO:
      return {Kind::kGone, fmt::format("{} does not respond ({}: {}): try another cable or port", node, operation,
                                       std::strerror(code))};
    case EBUSY:
      return {Kind::kBusy,
              fmt::format("{} is in use by another program (`fuser -v {}` shows it): stop that program", node, node)};
    case EACCES:
    case EPERM:
      return {Kind::kNotAllowed,
              fmt::format("no permission to open {}: run sudo usermod -aG video $USER, then log in again", node)};
    case ENOSPC:
      return {Kind::kOther, fmt::format("{}: not enough USB bandwidth ({}): use MJPG, a smaller size, a lower rate, "
                                        "or a port of another USB controller",
                                        node, operation)};
    default:
      return {Kind::kOther, fmt::format("{}: {} fails: {}; if this persists, unplug and reconnect the camera", node,
                                        operation, std::strerror(code))};
  }
}

DeviceFile::DeviceFile(std::string node)
    : node_(std::move(node)), descriptor_(open(node_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {
  if (descriptor_ < 0) throw error_of(node_, "open", errno);
}

DeviceFile::~DeviceFile() { close(descriptor_); }

bool DeviceFile::try_request(unsigned long code, void* argument) const {
  int result = 0;
  do {
    result = ioctl(descriptor_, code, argument);
  } while (result < 0 && errno == EINTR);
  return result >= 0;
}

void DeviceFile::request(unsigned long code, void* argument, const char* name) const {
  if (!try_request(code, argument)) throw error_of(node_, name, errno);
}

std::string text_of(const std::uint8_t* text, std::size_t size) {
  return {reinterpret_cast<const char*>(text), strnlen(reinterpret_cast<const char*>(text), size)};
}

}  // namespace panvo::v4l2_camera::kernel

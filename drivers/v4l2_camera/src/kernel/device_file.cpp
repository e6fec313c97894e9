// SPDX-License-Identifier: Apache-2.0
#include "kernel/device_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "usb_interface.hpp"

namespace panvo::v4l2_camera::kernel {
namespace {

namespace fs = std::filesystem;

fs::path usb_interface_of(int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return {};
  return usb_interface(fmt::format("/sys/dev/char/{}:{}", major(status.st_rdev), minor(status.st_rdev)));
}

/// The kernel deletes the folder of a USB interface after its driver has released the camera.
void wait_until_deleted(const fs::path& folder) {
  constexpr auto kMax = std::chrono::seconds(1);
  constexpr auto kStep = std::chrono::milliseconds(5);
  const auto give_up = std::chrono::steady_clock::now() + kMax;
  std::error_code error;
  while (fs::exists(folder, error) && std::chrono::steady_clock::now() < give_up) std::this_thread::sleep_for(kStep);
}

}  // namespace

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
  usb_interface_ = usb_interface_of(descriptor_);
}

// Linux 6.1 kills the thread that closes a camera while the camera is being removed: v4l2_device_release and
// media_device_unregister, which both unregister its media entity, are not protected from each other.
DeviceFile::~DeviceFile() {
  if (!usb_interface_.empty() && is_removed()) wait_until_deleted(usb_interface_);
  close(descriptor_);
}

bool DeviceFile::is_removed() const {
  v4l2_capability capability{};
  return !try_request(VIDIOC_QUERYCAP, &capability) && errno == ENODEV;
}

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

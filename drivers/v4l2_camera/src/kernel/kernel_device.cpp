// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "kernel/device_file.hpp"

namespace panvo::v4l2_camera::kernel {
namespace {

constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

/// A driver's buffer, mapped into this process.
class Mapping {
 public:
  Mapping(int descriptor, std::size_t size, std::int64_t offset)
      : size_(size), address_(mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, static_cast<off_t>(offset))) {}
  ~Mapping() {
    if (is_there()) munmap(address_, size_);
  }
  Mapping(Mapping&& other) noexcept : size_(other.size_), address_(std::exchange(other.address_, MAP_FAILED)) {}
  Mapping& operator=(Mapping&&) = delete;
  bool is_there() const noexcept { return address_ != MAP_FAILED; }
  std::span<const std::uint8_t> bytes() const { return {static_cast<const std::uint8_t*>(address_), size_}; }

 private:
  std::size_t size_;
  void* address_;
};

class KernelDevice final : public VideoDevice {
 public:
  explicit KernelDevice(const std::string& node) : file_(node) {
    v4l2_capability capability{};
    file_.request(VIDIOC_QUERYCAP, &capability, "VIDIOC_QUERYCAP");
    const auto has = [&](std::uint32_t flag) { return (capability.device_caps & flag) != 0; };
    if (has(V4L2_CAP_VIDEO_CAPTURE) && has(V4L2_CAP_STREAMING)) return;
    const char* what = has(V4L2_CAP_VIDEO_CAPTURE_MPLANE) ? "sends multi-planar images, which are not supported"
                                                          : "is not a camera; use the first node of a camera";
    throw DeviceError(DeviceError::Kind::kOther,
                      fmt::format("{} {}: `panvo devices` lists cameras", file_.node(), what));
  }

  ~KernelDevice() override {
    if (!is_streaming_) return;
    auto type = static_cast<int>(kCapture);
    ioctl(file_.descriptor(), VIDIOC_STREAMOFF, &type);
  }

  std::vector<OfferedFormat> offered_formats() override { return kernel::offered_formats(file_); }

  ImageFormat format() override {
    v4l2_format format{};
    format.type = kCapture;
    file_.request(VIDIOC_G_FMT, &format, "VIDIOC_G_FMT");
    return format_of(format);
  }

  ImageFormat set_format(const ImageFormat& wanted) override {
    v4l2_format format{};
    format.type = kCapture;
    format.fmt.pix.width = static_cast<std::uint32_t>(wanted.width);
    format.fmt.pix.height = static_cast<std::uint32_t>(wanted.height);
    format.fmt.pix.pixelformat = wanted.pixels;
    format.fmt.pix.field = V4L2_FIELD_NONE;
    file_.request(VIDIOC_S_FMT, &format, "VIDIOC_S_FMT");
    return format_of(format);
  }

  double rate_hz() override {
    v4l2_streamparm parameters{};
    parameters.type = kCapture;
    return file_.try_request(VIDIOC_G_PARM, &parameters) ? rate_of(parameters.parm.capture.timeperframe) : 0.0;
  }

  double set_rate_hz(double wanted_hz) override {
    v4l2_streamparm parameters{};
    parameters.type = kCapture;
    if (!file_.try_request(VIDIOC_G_PARM, &parameters)) return 0.0;
    if ((parameters.parm.capture.capability & V4L2_CAP_TIMEPERFRAME) == 0) return 0.0;
    constexpr std::uint32_t kParts = 1000;
    parameters.parm.capture.timeperframe = {kParts, static_cast<std::uint32_t>(std::lround(wanted_hz * kParts))};
    file_.request(VIDIOC_S_PARM, &parameters, "VIDIOC_S_PARM");
    return rate_of(parameters.parm.capture.timeperframe);
  }

  std::vector<Control> controls() override { return controls_of(file_); }
  void set_control(const Control& control, std::int64_t value) override { kernel::set_control(file_, control, value); }
  std::int64_t control(const Control& control) override { return get_control(file_, control); }

  void start(int buffers) override {
    v4l2_requestbuffers wanted{};
    wanted.count = static_cast<std::uint32_t>(buffers);
    wanted.type = kCapture;
    wanted.memory = V4L2_MEMORY_MMAP;
    file_.request(VIDIOC_REQBUFS, &wanted, "VIDIOC_REQBUFS");
    for (unsigned index = 0; index < wanted.count; ++index) {
      v4l2_buffer buffer = described(index);
      file_.request(VIDIOC_QUERYBUF, &buffer, "VIDIOC_QUERYBUF");
      mappings_.emplace_back(file_.descriptor(), buffer.length, buffer.m.offset);
      if (!mappings_.back().is_there()) throw error_of(file_.node(), "mmap", errno);
      file_.request(VIDIOC_QBUF, &buffer, "VIDIOC_QBUF");
    }
    auto type = static_cast<int>(kCapture);
    file_.request(VIDIOC_STREAMON, &type, "VIDIOC_STREAMON");
    is_streaming_ = true;
  }

  std::optional<BufferedFrame> receive(std::chrono::milliseconds limit) override {
    pollfd waiting{file_.descriptor(), POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(limit.count())) <= 0) return std::nullopt;
    v4l2_buffer buffer = described(0);
    if (!file_.try_request(VIDIOC_DQBUF, &buffer)) {
      if (errno == EAGAIN && (waiting.revents & POLLERR) == 0) return std::nullopt;
      throw error_of(file_.node(), "VIDIOC_DQBUF", errno == EAGAIN || errno == EINVAL ? EIO : errno);
    }
    BufferedFrame frame;
    frame.buffer = buffer.index;
    frame.number = buffer.sequence;
    const auto bytes = mappings_.at(buffer.index).bytes();
    frame.bytes = bytes.first(std::min<std::size_t>(buffer.bytesused, bytes.size()));
    frame.is_damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
    if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC)
      frame.monotonic_ns = std::int64_t{buffer.timestamp.tv_sec} * 1'000'000'000 + buffer.timestamp.tv_usec * 1000;
    frame.is_stamped_at_start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
    return frame;
  }

  void give_back(const BufferedFrame& frame) override {
    v4l2_buffer buffer = described(frame.buffer);
    file_.request(VIDIOC_QBUF, &buffer, "VIDIOC_QBUF");
  }

 private:
  static v4l2_buffer described(unsigned index) {
    v4l2_buffer buffer{};
    buffer.index = index;
    buffer.type = kCapture;
    buffer.memory = V4L2_MEMORY_MMAP;
    return buffer;
  }

  static ImageFormat format_of(const v4l2_format& format) {
    const auto& pixels = format.fmt.pix;
    return {pixels.pixelformat, static_cast<int>(pixels.width), static_cast<int>(pixels.height),
            coding_of(pixels.pixelformat) == Coding::kRaw ? pixels.bytesperline : 0U};
  }

  DeviceFile file_;
  std::vector<Mapping> mappings_;
  bool is_streaming_ = false;
};

}  // namespace
}  // namespace panvo::v4l2_camera::kernel

namespace panvo::v4l2_camera {

std::unique_ptr<VideoDevice> open_video_device(const std::string& node) {
  return std::make_unique<kernel::KernelDevice>(node);
}

}  // namespace panvo::v4l2_camera

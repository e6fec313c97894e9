// SPDX-License-Identifier: Apache-2.0
#include "fake_device.hpp"

#include <chrono>
#include <utility>

namespace panvo::v4l2_camera::testing {
namespace {

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

class FakeDevice final : public VideoDevice {
 public:
  FakeDevice(FakeUsb& usb, std::shared_ptr<FakeUsb::Camera> camera) : usb_(usb), camera_(std::move(camera)) {}

  std::vector<OfferedFormat> offered_formats() override { return locked()->formats; }
  ImageFormat format() override { return locked()->format; }
  ImageFormat set_format(const ImageFormat&) override { return locked()->format; }
  double rate_hz() override { return locked()->rate_hz; }
  double set_rate_hz(double wanted_hz) override { return wanted_hz; }
  std::vector<Control> controls() override {
    std::vector<Control> controls;
    for (const auto& [name, value] : locked()->values) {
      controls.push_back({.id = static_cast<std::uint32_t>(controls.size()), .name = name, .least = 0, .most = 100});
    }
    return controls;
  }
  void set_control(const Control& control, std::int64_t value) override { locked()->values[control.name] = value; }
  std::int64_t control(const Control& control) override { return locked()->values[control.name]; }

  void start(int) override {
    const auto camera = locked();
    if (camera->start_error) throw DeviceError(*camera->start_error);
    ++camera->starts;
  }
  std::optional<BufferedFrame> receive(std::chrono::milliseconds limit) override {
    std::unique_lock lock(usb_.mutex_);
    usb_.sent_.wait_for(lock, limit, [this] { return camera_->is_unplugged || !camera_->waiting.empty(); });
    throw_if_gone();
    if (camera_->waiting.empty()) return std::nullopt;
    const auto frame = camera_->waiting.front();
    camera_->waiting.pop_front();
    return frame;
  }
  void give_back(const BufferedFrame&) override { ++locked()->given_back; }

 private:
  struct Locked {
    std::unique_lock<std::mutex> lock;
    FakeUsb::Camera* camera;
    FakeUsb::Camera* operator->() const { return camera; }
  };
  Locked locked() {
    std::unique_lock lock(usb_.mutex_);
    throw_if_gone();
    return {std::move(lock), camera_.get()};
  }
  void throw_if_gone() const {
    if (camera_->is_unplugged) throw DeviceError(DeviceError::Kind::kGone, camera_->node.path + " is gone");
  }

  FakeUsb& usb_;
  std::shared_ptr<FakeUsb::Camera> camera_;
};

std::shared_ptr<FakeUsb::Camera> FakeUsb::plug_in(const VideoNode& node) {
  const std::lock_guard lock(mutex_);
  auto camera = std::make_shared<Camera>();
  camera->node = node;
  cameras_[node.path] = camera;
  return camera;
}

void FakeUsb::unplug(const std::string& path) {
  const std::lock_guard lock(mutex_);
  cameras_.at(path)->is_unplugged = true;
  cameras_.erase(path);
  sent_.notify_all();
}

void FakeUsb::send(const std::string& path, std::uint32_t number, std::vector<std::uint8_t> bytes, bool is_damaged) {
  const std::lock_guard lock(mutex_);
  const auto found = cameras_.find(path);
  if (found == cameras_.end()) return;
  auto& camera = *found->second;
  camera.memory.push_back(std::move(bytes));
  BufferedFrame frame;
  frame.bytes = camera.memory.back();
  frame.number = number;
  frame.monotonic_ns = steady_ns();
  frame.is_damaged = is_damaged;
  camera.waiting.push_back(frame);
  sent_.notify_all();
}

Devices FakeUsb::devices() {
  return {[this] {
            const std::lock_guard lock(mutex_);
            std::vector<VideoNode> nodes;
            for (const auto& [path, camera] : cameras_) nodes.push_back(camera->node);
            return nodes;
          },
          [this](const std::string& path) -> std::unique_ptr<VideoDevice> {
            const std::lock_guard lock(mutex_);
            const auto found = cameras_.find(path);
            if (found == cameras_.end()) throw DeviceError(DeviceError::Kind::kGone, path + " is not there");
            if (found->second->open_error) throw DeviceError(*found->second->open_error);
            ++found->second->opened;
            return std::make_unique<FakeDevice>(*this, found->second);
          }};
}

}  // namespace panvo::v4l2_camera::testing

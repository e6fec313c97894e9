// SPDX-License-Identifier: Apache-2.0
#include "grabbed.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace panvo::test {

using v4l2_camera::CameraGrabber;
using v4l2_camera::CameraSettings;
using v4l2_camera::ImageParts;

Grabbed::Grabbed(CameraSettings settings)
    : log_("test",
           [this](runtime::LogLevel, const std::string&, const std::string& text) {
             const std::lock_guard lock(mutex_);
             text_ += text + "\n";
           }),
      grabber_(std::make_unique<CameraGrabber>(std::move(settings), log_, [this](Frame frame) {
        constexpr std::size_t kMax = 400;
        const std::lock_guard lock(mutex_);
        ++count_;
        if (frames_.size() == kMax) frames_.erase(frames_.begin());
        frames_.push_back(std::move(frame));
      })) {}

std::vector<Grabbed::Frame> Grabbed::frames() const {
  const std::lock_guard lock(mutex_);
  return frames_;
}

std::size_t Grabbed::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

std::string Grabbed::log() const {
  const std::lock_guard lock(mutex_);
  return text_;
}

bool Grabbed::more_come(std::size_t frames) const {
  const std::size_t before = count();
  return soon([&] { return count() >= before + frames; });
}

CameraSettings camera(const std::string& selector, ImageParts parts) {
  CameraSettings settings;
  settings.name = "camera";
  settings.camera = selector;
  settings.parts.parts = parts;
  settings.frame_ids = {"left"};
  if (parts != ImageParts::kOne) settings.frame_ids.emplace_back("right");
  return settings;
}

std::vector<double> mean_of(const sensor_msgs::msg::Image& image, double left, double right) {
  const std::size_t channels = image.step() / image.width();
  std::vector<double> sums(channels, 0.0);
  const auto first = static_cast<std::size_t>(left * image.width()),
             last = static_cast<std::size_t>(right * image.width());
  for (std::size_t row = 0; row < image.height(); ++row) {
    for (std::size_t column = first; column < last; ++column) {
      for (std::size_t channel = 0; channel < channels; ++channel)
        sums[channel] += image.data()[row * image.step() + column * channels + channel];
    }
  }
  for (auto& sum : sums) sum /= static_cast<double>((last - first) * image.height());
  return sums;
}

void set_control(const std::string& node, const std::string& name, std::int64_t value) {
  const auto device = v4l2_camera::open_video_device(node);
  for (const auto& control : device->controls()) {
    if (control.name == name) return device->set_control(control, value);
  }
  throw std::runtime_error(node + " has no control " + name);
}

bool soon(const std::function<bool()>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace panvo::test

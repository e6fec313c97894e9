// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "panvo/v4l2_camera/camera_grabber.hpp"

namespace panvo::test {

/// What a grabber delivers of one of the kernel's cameras.
class Grabbed {
 public:
  using Frame = v4l2_camera::CameraGrabber::Frame;

  explicit Grabbed(v4l2_camera::CameraSettings settings);

  /// The newest frames, at most some hundred; all are counted.
  std::vector<Frame> frames() const;
  std::size_t count() const;
  std::string log() const;
  bool log_contains(const std::string& text) const { return log().find(text) != std::string::npos; }
  camera_stream::StreamReport report() const { return grabber_->report(); }
  camera_stream::StreamCounters counters() const { return report().counters; }
  v4l2_camera::CameraGrabber& grabber() { return *grabber_; }

  /// Waits until that many more frames than now have come; false when they did not.
  bool more_come(std::size_t frames) const;

 private:
  mutable std::mutex mutex_;
  std::vector<Frame> frames_;
  std::size_t count_ = 0;
  std::string text_;
  runtime::Logger log_;
  std::unique_ptr<v4l2_camera::CameraGrabber> grabber_;  // last: it uses the others
};

/// Settings with a name and as many frames of reference as images come of a frame.
v4l2_camera::CameraSettings camera(const std::string& selector,
                                   v4l2_camera::ImageParts parts = v4l2_camera::ImageParts::kOne);

/// The mean of a region of an image in its first, second and third channel: relative to width and height, from 0 to 1.
std::vector<double> mean_of(const sensor_msgs::msg::Image& image, double left, double right);

/// Sets a control past the grabber, as another program would.
void set_control(const std::string& node, const std::string& name, std::int64_t value);

/// Looks every few milliseconds; false when it did not come true within 20 s.
bool soon(const std::function<bool()>& condition);

}  // namespace panvo::test

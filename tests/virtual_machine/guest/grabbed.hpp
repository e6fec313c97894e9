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

/// Collects the frames that a grabber delivers from a camera.
class Grabbed {
 public:
  using Frame = v4l2_camera::CameraGrabber::Frame;

  explicit Grabbed(v4l2_camera::CameraSettings settings);

  /// The newest frames, at most some hundred; count() counts all.
  std::vector<Frame> frames() const;
  std::size_t count() const;
  std::string log() const;
  bool log_contains(const std::string& text) const { return log().find(text) != std::string::npos; }
  camera_stream::StreamReport report() const { return grabber_->report(); }
  camera_stream::StreamCounters counters() const { return report().counters; }
  v4l2_camera::CameraGrabber& grabber() { return *grabber_; }

  /// Waits until `frames` more frames have arrived; false if they do not.
  bool more_come(std::size_t frames) const;

 private:
  mutable std::mutex mutex_;
  std::vector<Frame> frames_;
  std::size_t count_ = 0;
  std::string text_;
  runtime::Logger log_;
  std::unique_ptr<v4l2_camera::CameraGrabber> grabber_;  // last: it uses the others
};

/// Settings with a name and one frame id per image of a frame.
v4l2_camera::CameraSettings camera(const std::string& selector,
                                   v4l2_camera::ImageParts parts = v4l2_camera::ImageParts::kOne);

/// Mean of each channel over the columns from `left` to `right`, given as fractions of the width.
std::vector<double> mean_of(const sensor_msgs::msg::Image& image, double left, double right);

/// Sets a control without the grabber, like another program.
void set_control(const std::string& node, const std::string& name, std::int64_t value);

/// Polls the condition every few milliseconds; false if it does not hold within 20 s.
bool soon(const std::function<bool()>& condition);

}  // namespace panvo::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "panvo/camera_stream/camera_role.hpp"
#include "panvo/camera_stream/stamp_pairing.hpp"
#include "panvo/runtime/context.hpp"
#include "panvo/v4l2_camera/camera_grabber.hpp"

namespace panvo::v4l2_camera {

/// An image that is published.
struct ImageDescription {
  camera_stream::CameraRole role;
  std::optional<sensor_msgs::msg::CameraInfo> calibration;
};

/// Devices, and the images that come of them in the devices' order: one of each, or both eyes of one.
struct GroupDescription {
  std::vector<CameraSettings> devices;
  std::vector<ImageDescription> images;
  std::int64_t tolerance_ns = 0;
};

/// Cameras that belong together: each grabbed on its own, brought together by stamp, published under one stamp, and reported to diagnostics.
class CameraGroup {
 public:
  CameraGroup(runtime::Context& context, GroupDescription description);
  ~CameraGroup();
  CameraGroup(const CameraGroup&) = delete;
  CameraGroup& operator=(const CameraGroup&) = delete;

  /// Begins to open the cameras. What they send is published from now on.
  void start();

  /// Of each device, in order; see CameraGrabber::set_controls; from any thread.
  void set_controls(std::vector<std::vector<ControlSetting>> controls);

 private:
  using Images = std::vector<std::shared_ptr<sensor_msgs::msg::Image>>;
  struct Published {
    ImageDescription description;
    runtime::Output<sensor_msgs::msg::Image> images;
    runtime::Output<sensor_msgs::msg::CameraInfo> infos;
    std::string size_problem;  ///< of its calibration, as last told
  };

  void take(std::size_t device, CameraGrabber::Frame frame);
  void publish(std::int64_t stamp_ns, Images images);
  void publish_calibration(Published& published, const sensor_msgs::msg::Image& image);
  void report_each_second(const std::stop_token& stop);
  void report(double interval_s);

  runtime::Context& context_;
  runtime::Output<diagnostic_msgs::msg::DiagnosticArray> diagnostics_;
  std::mutex mutex_;  // guards pairing_ and what is published of it: the order of stamps
  camera_stream::StampPairing<Images> pairing_;
  std::vector<Published> published_;
  std::vector<CameraSettings> devices_;
  std::vector<camera_stream::StreamCounters> told_;
  std::mutex report_mutex_;
  std::condition_variable_any stopped_;
  std::mutex grabbers_mutex_;  // between start() and set_controls(); the others come after start()
  std::vector<std::unique_ptr<CameraGrabber>> grabbers_;
  std::jthread reporter_;  // last: it uses the others
};

}  // namespace panvo::v4l2_camera

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "panvo/aravis_camera/camera_grabber.hpp"
#include "panvo/camera_stream/camera_role.hpp"
#include "panvo/camera_stream/stamp_pairing.hpp"
#include "panvo/runtime/context.hpp"

namespace panvo::aravis_camera {

/// One camera of a group: what it is and how it is set.
struct CameraOfGroup {
  camera_stream::CameraRole role;
  GrabberSettings settings;
  std::optional<sensor_msgs::msg::CameraInfo> calibration;
};

/// The cameras of a rig: each grabbed on its own, brought together by stamp, published under one stamp, and reported to diagnostics.
class CameraGroup {
 public:
  CameraGroup(runtime::Context& context, std::vector<CameraOfGroup> cameras, std::int64_t tolerance_ns);
  ~CameraGroup();
  CameraGroup(const CameraGroup&) = delete;
  CameraGroup& operator=(const CameraGroup&) = delete;

  /// Begins to open the cameras. What they send is published from now on.
  void start();

  /// Of each camera, in order; see CameraGrabber::set_features; from any thread.
  void set_features(std::vector<std::vector<FeatureSetting>> features);

 private:
  using ImagePtr = std::shared_ptr<sensor_msgs::msg::Image>;
  struct Camera {
    CameraOfGroup description;
    runtime::Output<sensor_msgs::msg::Image> images;
    runtime::Output<sensor_msgs::msg::CameraInfo> infos;
    std::string size_problem;  ///< of its calibration, as last told
    camera_stream::StreamCounters told;
  };

  void take(std::size_t index, CameraGrabber::Frame frame);
  void publish(std::int64_t stamp_ns, std::vector<ImagePtr> images);
  void publish_calibration(Camera& camera, const sensor_msgs::msg::Image& image);
  void report_each_second(const std::stop_token& stop);
  void report(double interval_s);

  runtime::Context& context_;
  runtime::Output<diagnostic_msgs::msg::DiagnosticArray> diagnostics_;
  std::mutex mutex_;  // guards pairing_ and what is published of it: the order of stamps
  camera_stream::StampPairing<ImagePtr> pairing_;
  std::vector<Camera> cameras_;
  std::mutex report_mutex_;
  std::condition_variable_any stopped_;
  std::mutex grabbers_mutex_;  // between start() and set_features(); the others come after start()
  std::vector<std::unique_ptr<CameraGrabber>> grabbers_;
  std::jthread reporter_;  // last: it uses the others
};

}  // namespace panvo::aravis_camera

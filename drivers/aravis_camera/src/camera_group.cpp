// SPDX-License-Identifier: Apache-2.0
#include "camera_group.hpp"

#include <chrono>
#include <utility>

#include "panvo/camera_stream/camera_info_file.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::aravis_camera {
namespace {

std::int64_t system_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

CameraGroup::CameraGroup(runtime::Context& context, std::vector<CameraOfGroup> cameras, std::int64_t tolerance_ns)
    : context_(context),
      diagnostics_(context.output(topics::kDiagnostics)),
      pairing_({.streams = cameras.size(), .tolerance_ns = tolerance_ns}) {
  for (auto& camera : cameras) {
    auto images = context.output(camera.role.images);
    auto infos = context.output(camera.role.infos);
    cameras_.push_back({std::move(camera), std::move(images), std::move(infos), "", {}});
  }
}

CameraGroup::~CameraGroup() {
  reporter_ = {};
  // All at once: closing takes seconds where a device does not answer.
  std::vector<std::jthread> closing;
  for (auto& grabber : grabbers_) closing.emplace_back([&grabber] { grabber.reset(); });
}

void CameraGroup::start() {
  const std::lock_guard lock(grabbers_mutex_);
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    grabbers_.push_back(
        std::make_unique<CameraGrabber>(cameras_[i].description.settings, context_.log(),
                                        [this, i](CameraGrabber::Frame frame) { take(i, std::move(frame)); }));
  }
  reporter_ = std::jthread([this](const std::stop_token& stop) { report_each_second(stop); });
}

void CameraGroup::set_features(std::vector<std::vector<FeatureSetting>> features) {
  const std::lock_guard lock(grabbers_mutex_);
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    cameras_[i].description.settings.camera.features = features[i];  // for those that are yet to be opened
    if (i < grabbers_.size()) grabbers_[i]->set_features(std::move(features[i]));
  }
}

void CameraGroup::take(std::size_t index, CameraGrabber::Frame frame) {
  const std::lock_guard lock(mutex_);
  for (auto& [stamp_ns, images] : pairing_.push(index, frame.stamp_ns, std::move(frame.image)))
    publish(stamp_ns, std::move(images));
}

void CameraGroup::publish(std::int64_t stamp_ns, std::vector<ImagePtr> images) {
  const auto stamp = conversions::to_stamp(stamp_ns);
  for (std::size_t i = 0; i < images.size(); ++i) {
    images[i]->header().stamp(stamp);
    publish_calibration(cameras_[i], *images[i]);
  }
  for (std::size_t i = 0; i < images.size(); ++i) cameras_[i].images.publish(std::move(images[i]));
}

/// With each image; not with images of another size, to which it does not apply.
void CameraGroup::publish_calibration(Camera& camera, const sensor_msgs::msg::Image& image) {
  if (!camera.description.calibration) return;
  auto problem = camera_stream::size_problem(*camera.description.calibration, static_cast<int>(image.width()),
                                             static_cast<int>(image.height()));
  if (problem != camera.size_problem) {
    camera.size_problem = problem;
    if (!problem.empty())
      context_.log().warn("{}: {}; images go out without it", camera.description.role.name, problem);
  }
  if (!problem.empty()) return;
  auto info = *camera.description.calibration;
  info.header() = image.header();
  camera.infos.publish(std::move(info));
}

void CameraGroup::report_each_second(const std::stop_token& stop) {
  using std::chrono::steady_clock;
  auto last = steady_clock::now();
  std::unique_lock lock(report_mutex_);
  while (!stop.stop_requested()) {
    stopped_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
    if (stop.stop_requested()) return;
    const auto now = steady_clock::now();
    report(std::chrono::duration<double>(now - last).count());
    last = now;
  }
}

void CameraGroup::report(double interval_s) {
  diagnostic_msgs::msg::DiagnosticArray array;
  const std::int64_t now_ns = system_ns();
  array.header().stamp(conversions::to_stamp(now_ns));
  for (std::size_t i = 0; i < grabbers_.size(); ++i) {
    auto report = grabbers_[i]->report();
    {
      const std::lock_guard lock(mutex_);
      report.counters.unpaired = pairing_.unpaired(i);
      if (!cameras_[i].size_problem.empty()) report.details["calibration"] = cameras_[i].size_problem;
    }
    array.status().push_back(camera_stream::to_status(
        context_.name(), report, std::exchange(cameras_[i].told, report.counters), now_ns, interval_s));
  }
  diagnostics_.publish(std::move(array));
}

}  // namespace panvo::aravis_camera

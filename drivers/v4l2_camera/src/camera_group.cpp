// SPDX-License-Identifier: Apache-2.0
#include "camera_group.hpp"

#include <chrono>
#include <iterator>
#include <utility>

#include "panvo/camera_stream/camera_info_file.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::v4l2_camera {

CameraGroup::CameraGroup(runtime::Context& context, GroupDescription description)
    : context_(context),
      diagnostics_(context.output(topics::kDiagnostics)),
      pairing_({.streams = description.devices.size(), .tolerance_ns = description.tolerance_ns}),
      devices_(std::move(description.devices)),
      told_(devices_.size()) {
  for (auto& image : description.images) {
    auto images = context.output(image.role.images);
    auto infos = context.output(image.role.infos);
    published_.push_back({std::move(image), std::move(images), std::move(infos), ""});
  }
}

CameraGroup::~CameraGroup() {
  reporter_ = {};
  // All at once: a device that does not answer takes its time to be closed.
  std::vector<std::jthread> closing;
  for (auto& grabber : grabbers_) closing.emplace_back([&grabber] { grabber.reset(); });
}

void CameraGroup::start() {
  const std::lock_guard lock(grabbers_mutex_);
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    grabbers_.push_back(std::make_unique<CameraGrabber>(
        devices_[i], context_.log(), [this, i](CameraGrabber::Frame frame) { take(i, std::move(frame)); }));
  }
  reporter_ = std::jthread([this](const std::stop_token& stop) { report_each_second(stop); });
}

void CameraGroup::set_controls(std::vector<std::vector<ControlSetting>> controls) {
  const std::lock_guard lock(grabbers_mutex_);
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    devices_[i].controls = controls[i];  // for those that are yet to be opened
    if (i < grabbers_.size()) grabbers_[i]->set_controls(std::move(controls[i]));
  }
}

void CameraGroup::take(std::size_t device, CameraGrabber::Frame frame) {
  const std::lock_guard lock(mutex_);
  for (auto& set : pairing_.push(device, frame.stamp_ns, std::move(frame.images))) {
    Images all;
    for (auto& images : set.items) std::move(images.begin(), images.end(), std::back_inserter(all));
    publish(set.stamp_ns, std::move(all));
  }
}

void CameraGroup::publish(std::int64_t stamp_ns, Images images) {
  const auto stamp = conversions::to_stamp(stamp_ns);
  for (std::size_t i = 0; i < images.size(); ++i) {
    images[i]->header().stamp(stamp);
    publish_calibration(published_[i], *images[i]);
  }
  for (std::size_t i = 0; i < images.size(); ++i) published_[i].images.publish(std::move(images[i]));
}

/// With each image; not with images of another size, to which it does not apply.
void CameraGroup::publish_calibration(Published& published, const sensor_msgs::msg::Image& image) {
  const auto& calibration = published.description.calibration;
  if (!calibration) return;
  auto problem =
      camera_stream::size_problem(*calibration, static_cast<int>(image.width()), static_cast<int>(image.height()));
  if (problem != published.size_problem) {
    published.size_problem = problem;
    if (!problem.empty())
      context_.log().warn("{}: {}; images go out without it", published.description.role.name, problem);
  }
  if (!problem.empty()) return;
  auto info = *calibration;
  info.header() = image.header();
  published.infos.publish(std::move(info));
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
  using std::chrono::nanoseconds;
  const std::int64_t now_ns =
      std::chrono::duration_cast<nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  diagnostic_msgs::msg::DiagnosticArray array;
  array.header().stamp(conversions::to_stamp(now_ns));
  for (std::size_t i = 0; i < grabbers_.size(); ++i) {
    auto report = grabbers_[i]->report();
    {
      const std::lock_guard lock(mutex_);
      report.counters.unpaired = pairing_.unpaired(i);
      for (const auto& published : published_) {
        if (!published.size_problem.empty())
          report.details["calibration " + published.description.role.name] = published.size_problem;
      }
    }
    array.status().push_back(camera_stream::to_status(context_.name(), report, std::exchange(told_[i], report.counters),
                                                      now_ns, interval_s));
  }
  diagnostics_.publish(std::move(array));
}

}  // namespace panvo::v4l2_camera

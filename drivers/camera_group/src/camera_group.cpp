// SPDX-License-Identifier: Apache-2.0
#include "panvo/camera_group/camera_group.hpp"

#include <chrono>
#include <condition_variable>
#include <iterator>
#include <mutex>
#include <thread>
#include <utility>

#include "image_publisher.hpp"
#include "panvo/camera_stream/stamp_pairing.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/interfaces/node_topics.hpp"

namespace panvo::camera_group {

class CameraGroup::Implementation {
 public:
  Implementation(runtime::Context& context, Description description)
      : context_(context),
        diagnostics_(context.output(topics::kDiagnostics)),
        pairing_({.streams = description.devices.size(), .tolerance_ns = description.tolerance_ns}),
        devices_(std::move(description.devices)),
        told_(devices_.size()) {
    for (auto& image : description.images) published_.emplace_back(context, std::move(image));
  }

  ~Implementation() {
    reporter_ = {};
    // In parallel, because closing an unresponsive device takes seconds.
    std::vector<std::jthread> closing;
    for (auto& grabber : grabbers_) closing.emplace_back([&grabber] { grabber.reset(); });
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void start() {
    const std::lock_guard lock(grabbers_mutex_);
    for (std::size_t i = 0; i < devices_.size(); ++i) {
      grabbers_.push_back(devices_[i]([this, i](GrabbedFrame frame) { take(i, std::move(frame)); }));
      if (!settings_.empty()) grabbers_.back()->set(settings_.at(i));
    }
    reporter_ = std::jthread([this](const std::stop_token& stop) { report_each_second(stop); });
  }

  void set(std::vector<std::vector<DeviceSetting>> settings) {
    const std::lock_guard lock(grabbers_mutex_);
    settings_ = std::move(settings);  // for grabbers created later
    for (std::size_t i = 0; i < grabbers_.size(); ++i) grabbers_[i]->set(settings_.at(i));
  }

 private:
  using Images = std::vector<std::shared_ptr<sensor_msgs::msg::Image>>;

  void take(std::size_t device, GrabbedFrame frame) {
    const std::lock_guard lock(mutex_);
    for (auto& set : pairing_.push(device, frame.stamp_ns, std::move(frame.images))) {
      Images all;
      for (auto& images : set.items) std::move(images.begin(), images.end(), std::back_inserter(all));
      publish(set.stamp_ns, std::move(all));
    }
  }

  void publish(std::int64_t stamp_ns, Images images) {
    const auto stamp = conversions::to_stamp(stamp_ns);
    for (std::size_t i = 0; i < images.size(); ++i) {
      images[i]->header().stamp(stamp);
      published_.at(i).publish_calibration_of(*images[i]);
    }
    for (std::size_t i = 0; i < images.size(); ++i) published_[i].publish(std::move(images[i]));
  }

  void report_each_second(const std::stop_token& stop) {
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

  void report(double interval_s) {
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
        if (grabbers_.size() > 1) {
          add_size_problem(report, "calibration", published_.at(i));
        } else {
          for (const auto& image : published_) add_size_problem(report, "calibration " + image.name(), image);
        }
      }
      array.status().push_back(camera_stream::to_status(context_.name(), report,
                                                        std::exchange(told_[i], report.counters), now_ns, interval_s));
    }
    diagnostics_.publish(std::move(array));
  }

  static void add_size_problem(camera_stream::StreamReport& report, const std::string& key,
                               const ImagePublisher& image) {
    if (!image.size_problem().empty()) report.details[key] = image.size_problem();
  }

  runtime::Context& context_;
  runtime::Output<diagnostic_msgs::msg::DiagnosticArray> diagnostics_;
  std::mutex mutex_;  // guards pairing_ and published_, and keeps stamps in order
  camera_stream::StampPairing<Images> pairing_;
  std::vector<ImagePublisher> published_;
  const std::vector<StartGrabber> devices_;
  std::vector<camera_stream::StreamCounters> told_;
  std::mutex report_mutex_;
  std::condition_variable_any stopped_;
  std::mutex grabbers_mutex_;  // between start() and set(); all other accesses happen after start()
  std::vector<std::vector<DeviceSetting>> settings_;
  std::vector<std::unique_ptr<Grabber>> grabbers_;
  std::jthread reporter_;  // last: it uses the others
};

CameraGroup::CameraGroup(runtime::Context& context, Description description)
    : implementation_(std::make_unique<Implementation>(context, std::move(description))) {}
CameraGroup::~CameraGroup() = default;
void CameraGroup::start() { implementation_->start(); }
void CameraGroup::set(std::vector<std::vector<DeviceSetting>> settings) { implementation_->set(std::move(settings)); }

}  // namespace panvo::camera_group
